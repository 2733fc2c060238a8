#pragma once

#include <span>
#include <vector>

#include "core/base/parallel.h"

namespace hybridrt {

/// What blur_boundary() keeps from frame to frame: per pixel the sums over its window's row.
struct BlurMemory {
  std::vector<uint8_t> lit, receivers;
};

/// Pass 3 of `--shadows blur` (paper, section 3.4): the k x k box blur of one light's shadow mask, along rows and then
/// along columns, in whole numbers. Adds HRT_MASK_MARKED to the receivers whose window holds both light and shadow.
/// `mask`: from test_shadows(), one element per pixel, rows from the top; `kernel_px` is odd, at most
/// kLargestBlurKernel_px.
void blur_boundary(int width_px, int kernel_px, ThreadPool& pool, BlurMemory& memory, std::span<uint8_t> mask);

}  // namespace hybridrt
