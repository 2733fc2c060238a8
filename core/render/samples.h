#pragma once

#include <span>

#include "core/render/frame.h"

namespace hybridrt {

/// A sample's place, in pixels from the pixel's centre, each coordinate in [-0.5, 0.5): the first in the centre, then
/// the R2 sequence of M. Roberts ("The Unreasonable Effectiveness of Quasirandom Sequences", 2018), which covers the
/// pixel evenly however many are taken. The same in every pixel, frame and method, so that errors are comparable.
dvec2 sample_offset_px(int sample);

/// Turns a pixel's sum of samples into their mean. `pixel`: its channels; where the last of two or four is alpha,
/// colours are the mean of the samples that see a surface.
void take_mean(std::span<float> pixel, int samples);

/// Of frames with so many pixels, of which `resampled` are near edges.
int64_t samples_taken(const RenderSettings& settings, int64_t pixels, int64_t resampled);

/// Repeats each request `samples` times, with the offset of each sample.
[[nodiscard]] NextFrame sampled(NextFrame next, int samples);

/// The counterpart: waits for all samples of a frame, in order, and delivers their mean. Times and counts are summed;
/// AOVs are those of the first sample, as triangle numbers have no mean.
[[nodiscard]] DeliverFrame averaged(DeliverFrame deliver, int samples);

}  // namespace hybridrt
