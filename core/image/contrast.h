#pragma once

#include <span>

#include "core/base/parallel.h"
#include "core/image/image.h"

namespace hybridrt {

/// Whether two colours differ by more than `threshold` in a channel, both as square roots: about as displays encode
/// them, where 1 is white.
bool contrasts(std::span<const float> a, std::span<const float> b, float threshold);

/// 1 for each pixel that contrasts with the one above, below, left or right of it; `marks` has an element per pixel.
void mark_contrasts(const Image& picture, float threshold, ThreadPool& pool, std::span<uint8_t> marks);

}  // namespace hybridrt
