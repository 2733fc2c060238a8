#pragma once

#include <vector>

#include "core/render/frame.h"

namespace hybridrt {

/// Where a pixel's sample lies, in pixels from its centre, each in [-0.5, 0.5): the first in the centre, then the R2
/// sequence of M. Roberts ("The Unreasonable Effectiveness of Quasirandom Sequences", 2018), which covers the pixel
/// evenly however many are taken. The same in every pixel, frame and method, so that errors are comparable.
dvec2 sample_offset_px(int sample);

/// Each request `samples` times over, with the offset of each sample.
[[nodiscard]] NextFrame sampled(NextFrame next, int samples);

/// The other end: waits for all samples of a frame, in order, and delivers their mean. Times and counts are summed;
/// AOVs are those of the first sample, as triangle numbers have no mean.
[[nodiscard]] DeliverFrame averaged(DeliverFrame deliver, int samples);

}  // namespace hybridrt
