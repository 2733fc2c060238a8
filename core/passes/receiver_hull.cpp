#include "core/passes/receiver_hull.h"

#include <algorithm>

#include "core/base/check.h"
#include "shaders/shared.h"

namespace hybridrt {

int receiver_blocks(int pixels) { return (pixels + HRT_RECEIVER_BLOCK_PX - 1) / HRT_RECEIVER_BLOCK_PX; }

std::vector<dvec3> receiver_hull(const View& view, double near_distance, std::span<const vec2> blocks) {
  const int across = receiver_blocks(view.width_px), down = receiver_blocks(view.height_px);
  HRT_CHECK(blocks.size() == static_cast<size_t>(across) * down);
  // To the pixels' outer edges; `edge` counts from the sample of pixel 0.
  const auto dir_at = [&](double edge_x, double edge_y) {
    return view.ray_first() + (view.x_px + edge_x - 0.5) * view.ray_step_x() +
           (view.y_px + edge_y - 0.5) * view.ray_step_y();
  };
  std::vector<dvec3> points;
  for (int y = 0; y < down; ++y)
    for (int x = 0; x < across; ++x) {
      const vec2 depths = blocks[static_cast<size_t>(y) * across + x];
      if (!(depths.x > 0)) continue;
      const int first_x = x * HRT_RECEIVER_BLOCK_PX, end_x = std::min(first_x + HRT_RECEIVER_BLOCK_PX, view.width_px);
      const int first_y = y * HRT_RECEIVER_BLOCK_PX, end_y = std::min(first_y + HRT_RECEIVER_BLOCK_PX, view.height_px);
      for (int edge_x : {first_x, end_x})
        for (int edge_y : {first_y, end_y})
          for (float depth : {depths.x, depths.y})  // reversed: near / distance
            points.push_back(near_distance / static_cast<double>(depth) * dir_at(edge_x, edge_y));
    }
  return points;
}

}  // namespace hybridrt
