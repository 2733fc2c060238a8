#pragma once

#include <string>
#include <vector>

#include "core/render/frame.h"

namespace hybridrt {

// A frame's times and counts as tables have them: timings.csv, and the sweep's rows. docs/formats.md tells what they
// are.

/// "shadow_map_ms", … "write_ms", "wall_ms", "pixels_hit" and so on, in the order of frame_cells().
std::vector<std::string> frame_columns();

/// Milliseconds with three decimals, counts as whole numbers; dot decimals whatever the locale.
std::vector<std::string> frame_cells(const FrameTimings& timings, const TraceStats& stats);

}  // namespace hybridrt
