#include "core/passes_cpu/receiver_depths.h"

#include <gtest/gtest.h>

#include "core/passes/receiver_hull.h"
#include "shaders/shared.h"
#include "tests/support/raster_views.h"

namespace hybridrt {
namespace {

TEST(ReceiverDepths, AreTheNearestAndTheFarthestHitOfEachBlock) {
  const double near_distance = 1e-6;
  ThreadPool pool(2);
  Random random(61);
  for (const Scene& scene : {random_soup(62, 200, 0.4f), slivers(63, 200), closed_sphere(24, 12)})
    for (int i = 0; i < 12; ++i) {
      const View view = random_view(scene, random);
      const KdTree tree = build_kd_tree(scene, pool);
      const auto caster = make_reference_caster(tree);
      const std::vector<uint32_t> ids = reference_ids(*caster, view, pool);
      const int across = receiver_blocks(view.width_px), down = receiver_blocks(view.height_px);
      std::vector<vec2> blocks(static_cast<size_t>(across) * down, vec2(7)), truth(blocks.size(), vec2(0, 2));
      receiver_depths(scene, view, near_distance, ids, pool, blocks);
      for (int y = 0; y < view.height_px; ++y)
        for (int x = 0; x < view.width_px; ++x) {
          const Ray<double> ray{view.eye, glm::normalize(view.pixel_dir(x, y))};
          Hit<double> hit;
          caster->closest_hits({&ray, 1}, {&hit, 1});
          if (!hit.found()) continue;
          const double distance = hit.t * glm::dot(ray.dir, view.forward);
          const auto depth = static_cast<float>(std::min(1.0, near_distance / distance));
          vec2& block = truth[static_cast<size_t>(y / HRT_RECEIVER_BLOCK_PX) * across + x / HRT_RECEIVER_BLOCK_PX];
          block = {std::max(block.x, depth), std::min(block.y, depth)};
        }
      for (size_t b = 0; b < blocks.size(); ++b) {
        ASSERT_NEAR(blocks[b].x, truth[b].x, 1e-5f * truth[b].x) << i << ' ' << b;
        ASSERT_NEAR(blocks[b].y, truth[b].y, 1e-5f * truth[b].y) << i << ' ' << b;
      }
    }
}

}  // namespace
}  // namespace hybridrt
