#pragma once

#include <span>

#include "core/base/parallel.h"
#include "core/image/image.h"
#include "core/render/settings.h"
#include "core/trace/trace_job.h"

namespace hybridrt {

/// What pass 5 reads of a whole frame, one element per pixel of the view, rows from the top.
struct ShadedPixels {
  std::span<const uint32_t> ids;  ///< triangle seen, or kNoTriangle
  std::span<const uint8_t> lit;  ///< HRT_MASK_LIT counts; light after light, read for those that cast shadows; or empty
  std::span<const vec4> traced;  ///< light of reflected and refracted rays; or empty
};

/// Pass 5 on the CPU for a frame whose other passes are done: shade() of the pixels in `kept`, which become `picture`
/// (linear; with four channels the last is coverage). Counts `pixels_hit` and `pixels_lit`.
void shade_frame(const TraceJob& job, ThreadPool& pool, const ShadedPixels& pixels, const PixelRect& kept,
                 Image& picture, TraceStats& stats);

}  // namespace hybridrt
