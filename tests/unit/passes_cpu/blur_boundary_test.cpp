#include "core/passes_cpu/blur_boundary.h"

#include <gtest/gtest.h>

#include "shaders/shared.h"
#include "tests/support/trace_scenes.h"

namespace hybridrt {
namespace {

std::vector<uint8_t> marked(std::vector<uint8_t> mask, int width, int kernel_px, int threads) {
  ThreadPool pool(threads);
  BlurMemory memory;
  blur_boundary(width, kernel_px, pool, memory, mask);
  return mask;
}

/// Pixel by pixel, all of its window.
std::vector<uint8_t> marked_by_windows(const std::vector<uint8_t>& mask, int width, int kernel_px) {
  const int height = static_cast<int>(mask.size()) / width, radius = kernel_px / 2;
  std::vector<uint8_t> result = mask;
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      int lit = 0, receivers = 0;
      for (int v = std::max(0, y - radius); v <= std::min(height - 1, y + radius); ++v)
        for (int u = std::max(0, x - radius); u <= std::min(width - 1, x + radius); ++u) {
          lit += mask[static_cast<size_t>(v) * width + u] == HRT_MASK_LIT;
          receivers += mask[static_cast<size_t>(v) * width + u] != HRT_MASK_NO_RECEIVER;
        }
      uint8_t& here = result[static_cast<size_t>(y) * width + x];
      if (here != HRT_MASK_NO_RECEIVER && lit > 0 && lit < receivers) here |= HRT_MASK_MARKED;
    }
  return result;
}

TEST(BlurBoundary, MarksReceiversWhoseWindowHoldsLightAndShadow) {
  Random random(71);
  for (const auto& [width, height] : {std::pair{1, 1}, {3, 200}, {200, 3}, {77, 150}, {130, 65}})
    for (const int kernel_px : {1, 3, 5, 9, 31}) {
      std::vector<uint8_t> mask(static_cast<size_t>(width) * height);
      const uint32_t share = 2 + random.below(200);  // from noise to a few lonely pixels
      for (uint8_t& value : mask)
        value = random.below(share) != 0 ? HRT_MASK_LIT : random.below(2) != 0 ? 0 : HRT_MASK_NO_RECEIVER;
      const std::vector<uint8_t> truth = marked_by_windows(mask, width, kernel_px);
      EXPECT_EQ(marked(mask, width, kernel_px, 1), truth) << width << 'x' << height << ' ' << kernel_px;
      EXPECT_EQ(marked(mask, width, kernel_px, 4), truth) << width << 'x' << height << ' ' << kernel_px;
    }
}

}  // namespace
}  // namespace hybridrt
