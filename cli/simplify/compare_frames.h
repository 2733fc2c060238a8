#pragma once

#include <vector>

#include "core/render/render_job.h"

namespace hybridrt::cli {

/// A frame before and after.
struct FrameDifference {
  int frame = 1;
  double psnr_db = 0;  ///< of 8-bit display values; infinite where they are equal
  int outline_px = 0;  ///< outline_distance() at the pixels' centres
};

/// Renders the frames of `before` with both scenes, a few at a time; fewer if a signal asks to stop. Both jobs' frames
/// and settings are as before afterwards.
std::vector<FrameDifference> compare_frames(RenderJob& before, RenderJob& after, ThreadPool& pool);

}  // namespace hybridrt::cli
