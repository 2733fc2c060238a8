#include "core/simplify/silhouette.h"

#include <algorithm>
#include <vector>

#include "core/base/check.h"

namespace hybridrt {
namespace {

/// For each pixel the steps to the nearest one where `mask` is 1: two passes of a chamfer, exact for steps of
/// this kind (Rosenfeld and Pfaltz, Distance Functions on Digital Pictures, 1968).
std::vector<int> steps_to(std::span<const uint8_t> mask, int width, int height) {
  const int farthest = std::max(width, height);
  std::vector<int> steps(mask.size());
  for (size_t i = 0; i < mask.size(); ++i) steps[i] = mask[i] ? 0 : farthest;
  const auto sweep = [&](int direction) {
    const int first_y = direction > 0 ? 0 : height - 1, first_x = direction > 0 ? 0 : width - 1;
    for (int y = first_y; y >= 0 && y < height; y += direction)
      for (int x = first_x; x >= 0 && x < width; x += direction) {
        int& here = steps[static_cast<size_t>(y * width + x)];
        const auto look = [&](int dx, int dy) {
          const int nx = x + dx, ny = y + dy;
          if (nx >= 0 && nx < width && ny >= 0 && ny < height)
            here = std::min(here, steps[static_cast<size_t>(ny * width + nx)] + 1);
        };
        look(-direction, 0);
        for (int dx = -1; dx <= 1; ++dx) look(dx, -direction);
      }
  };
  sweep(1);
  sweep(-1);
  return steps;
}

/// Of the pixels of `a` from those of `b`.
int farthest(std::span<const uint8_t> a, std::span<const uint8_t> b, int width, int height) {
  const std::vector<int> to_other = steps_to(b, width, height);
  int most = 0;
  for (size_t i = 0; i < a.size(); ++i)
    if (a[i]) most = std::max(most, to_other[i]);
  return most;
}

}  // namespace

int outline_distance(std::span<const uint8_t> a, std::span<const uint8_t> b, int width_px) {
  HRT_CHECK_EQ(a.size(), b.size());
  HRT_CHECK(width_px > 0 && a.size() % static_cast<size_t>(width_px) == 0);
  const int height_px = static_cast<int>(a.size()) / width_px;
  return std::max(farthest(a, b, width_px, height_px), farthest(b, a, width_px, height_px));
}

}  // namespace hybridrt
