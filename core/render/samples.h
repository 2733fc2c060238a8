#pragma once

#include <vector>

#include "core/render/frame.h"

namespace hybridrt {

/// A sample's place, in pixels from the pixel's centre, each coordinate in [-0.5, 0.5): the first in the centre, then
/// the R2 sequence of M. Roberts ("The Unreasonable Effectiveness of Quasirandom Sequences", 2018), which covers the
/// pixel evenly however many are taken. The same in every pixel, frame and method, so that errors are comparable.
dvec2 sample_offset_px(int sample);

/// Repeats each request `samples` times, with the offset of each sample.
[[nodiscard]] NextFrame sampled(NextFrame next, int samples);

/// The counterpart: waits for all samples of a frame, in order, and delivers their mean. Times and counts are summed;
/// AOVs are those of the first sample, as triangle numbers have no mean.
[[nodiscard]] DeliverFrame averaged(DeliverFrame deliver, int samples);

}  // namespace hybridrt
