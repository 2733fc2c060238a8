#include "core/passes_cpu/receiver_depths.h"

#include <algorithm>

#include "core/base/check.h"
#include "core/passes/receiver_hull.h"
#include "shaders/shared.h"

namespace hybridrt {
namespace {

/// A triangle's distances along the view. Neighbouring pixels see the same, so the last one is kept.
class SeenDistance {
 public:
  SeenDistance(const Scene& scene, const View& view, double near_distance)
      : scene_(scene), view_(view), near_distance_(near_distance) {}

  double at(uint32_t triangle, int x, int y) {
    if (triangle != triangle_) take(triangle);
    const double distance = offset_ / glm::dot(normal_, view_.pixel_dir(x, y));
    // Also where it is seen edge-on, or goes through the eye.
    return std::max(std::max(near_distance_, nearest_), std::min(farthest_, distance));
  }

 private:
  void take(uint32_t triangle) {
    triangle_ = triangle;
    const dvec3 p = from_eye(0), q = from_eye(1), r = from_eye(2);
    normal_ = glm::cross(q - p, r - p);
    offset_ = glm::dot(normal_, p);
    const double distances[] = {glm::dot(p, view_.forward), glm::dot(q, view_.forward), glm::dot(r, view_.forward)};
    nearest_ = *std::min_element(distances, distances + 3);
    farthest_ = *std::max_element(distances, distances + 3);
  }
  dvec3 from_eye(int corner) const { return dvec3(scene_.vertex(triangle_, corner)) - view_.eye; }

  const Scene& scene_;
  const View& view_;
  const double near_distance_;
  uint32_t triangle_ = kNoTriangle;
  dvec3 normal_{0};
  double offset_ = 0, nearest_ = 0, farthest_ = 0;
};

}  // namespace

void receiver_depths(const Scene& scene, const View& view, double near_distance, std::span<const uint32_t> ids,
                     ThreadPool& pool, std::span<vec2> blocks) {
  const int across = receiver_blocks(view.width_px), down = receiver_blocks(view.height_px);
  HRT_CHECK_EQ(ids.size(), static_cast<size_t>(view.width_px) * view.height_px);
  HRT_CHECK_EQ(blocks.size(), static_cast<size_t>(across) * down);
  std::fill(blocks.begin(), blocks.end(), vec2(0, 2));
  pool.run(static_cast<size_t>(down), [&](size_t row, int) {
    SeenDistance seen(scene, view, near_distance);
    const int first_y = static_cast<int>(row) * HRT_RECEIVER_BLOCK_PX;
    for (int y = first_y; y < std::min(first_y + HRT_RECEIVER_BLOCK_PX, view.height_px); ++y)
      for (int x = 0; x < view.width_px; ++x) {
        const uint32_t triangle = ids[static_cast<size_t>(y) * view.width_px + x];
        if (triangle == kNoTriangle) continue;
        const auto depth = static_cast<float>(near_distance / seen.at(triangle, x, y));
        vec2& block = blocks[row * across + x / HRT_RECEIVER_BLOCK_PX];
        block = {std::max(block.x, depth), std::min(block.y, depth)};
      }
  });
}

}  // namespace hybridrt
