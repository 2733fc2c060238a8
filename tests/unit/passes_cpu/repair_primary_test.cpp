// Small things on a ground so large that single precision misplaces it.

#include "core/passes_cpu/repair_primary.h"

#include <gtest/gtest.h>

#include "tests/support/brute_force.h"
#include "tests/support/trace_scenes.h"

namespace hybridrt {
namespace {

constexpr int kWidth_px = 80, kHeight_px = 60;

/// Things the size of 1 around the origin, on a ground `half_size` wide on each side. The ground comes last.
Scene on_large_ground(uint32_t seed, float half_size) {
  Scene scene = random_soup(seed, 60, 0.7f);
  const float y = scene.bounds.lo.y, s = half_size;
  add_triangle(scene, {-s, y, -s}, {s, y, -s}, {s, y, s});
  add_triangle(scene, {-s, y, -s}, {s, y, s}, {-s, y, s});
  scene.bounds.grow({-s, y, -s});
  scene.bounds.grow({s, y, s});
  return scene;
}

View near_view(const Scene& scene, Random& random) {
  const dvec3 eye(random.between(-4, 4), scene.bounds.lo.y + random.between(0.5f, 4), random.between(2, 4));
  return make_view({eye, dvec3(0), {0, 1, 0}, 0.8}, dvec3(0), kWidth_px, kHeight_px);
}

std::vector<uint32_t> true_ids(const Scene& scene, const View& view) {
  std::vector<uint32_t> ids;
  for (int y = 0; y < kHeight_px; ++y)
    for (int x = 0; x < kWidth_px; ++x)
      ids.push_back(brute_force_hit<double>(scene, {view.eye, glm::normalize(view.pixel_dir(x, y))}).triangle);
  return ids;
}

// Whatever the raster made of the picture, even where it tore a hole of many pixels.
TEST(RepairPrimary, TornPicturesAreRepaired) {
  ThreadPool pool(1);
  for (uint32_t seed = 0; seed < 12; ++seed) {
    Random random(seed);
    const Scene scene = on_large_ground(seed, std::pow(10.0f, random.between(6, 8)));
    const View view = near_view(scene, random);
    const std::vector<uint32_t> truth = true_ids(scene, view);
    std::vector<uint32_t> torn = truth;
    const int first = static_cast<int>(random.below(kWidth_px - 10));
    for (int y = 0; y < kHeight_px; ++y)
      for (int x = first; x < first + 10; ++x)
        torn[y * kWidth_px + x] =
            random.below(2) ? kNoTriangle : random.below(static_cast<uint32_t>(scene.triangle_count()));

    std::vector<uint32_t> repaired(torn.size());
    RasterMemory memory;
    const RepairStats stats =
        repair_primary_hits(scene, make_clusters(scene, pool), view, pool, memory, torn, repaired);
    int64_t torn_pixels = 0;
    for (size_t i = 0; i < truth.size(); ++i) torn_pixels += torn[i] != truth[i];
    EXPECT_EQ(repaired, truth) << "seed " << seed;
    EXPECT_EQ(stats.repaired, torn_pixels) << "seed " << seed;
  }
}

}  // namespace
}  // namespace hybridrt
