// The queue of RayGenerations, observed from outside by a caster that sees every batch.

#include "core/trace/ray_generations.h"

#include <gtest/gtest.h>

#include "core/trace/kd_caster.h"
#include "tests/support/trace_scenes.h"

namespace hybridrt {
namespace {

constexpr int kTile_px = 32;
constexpr int64_t kPrimary = kTile_px * kTile_px, kBatch = 4096;

/// Panes across x, each of which transmits all light and reflects all of it: rays double with every generation.
Scene doubling_panes(int panes) {
  Scene scene;
  Material pane;
  pane.kd = vec3(0);
  pane.transmit = pane.reflect = vec3(1);
  scene.materials = {pane};
  scene.normals = {{1, 0, 0}};
  for (int i = 0; i < panes; ++i) {
    const float x = static_cast<float>(i) - 0.5f * static_cast<float>(panes - 1);
    add_triangle(scene, {x, -1e4f, -1e4f}, {x, 2e4f, -1e4f}, {x, -1e4f, 2e4f});
    scene.triangle_normals.push_back(uvec3(0));
    scene.triangle_materials.push_back(0);
  }
  scene.bounds = compute_bounds(scene);
  return scene;
}

/// Forwards all queries and records how many rays were waiting each time.
class CountingCaster : public RayCaster<float> {
 public:
  CountingCaster(const KdTree& tree, const TraceStats& stats)
      : caster_(make_kd_caster(tree, LeafKernel::simd)), stats_(stats) {}

  void closest_hits(std::span<const Ray<float>> rays, std::span<Hit<float>> hits) const override {
    const int64_t fired = kPrimary + stats_.reflection_rays + stats_.refraction_rays;
    longest_queue = std::max(longest_queue, fired - taken);
    taken += static_cast<int64_t>(rays.size());
    largest_batch = std::max(largest_batch, static_cast<int64_t>(rays.size()));
    caster_->closest_hits(rays, hits);
  }
  void any_hits(std::span<const Ray<float>> rays, std::span<uint8_t> occluded) const override {
    caster_->any_hits(rays, occluded);
  }

  mutable int64_t longest_queue = 0, taken = 0, largest_batch = 0;

 private:
  std::unique_ptr<RayCaster<float>> caster_;
  const TraceStats& stats_;
};

TEST(RayQueue, StaysShortHoweverManyBranchesThereAre) {
  ThreadPool pool(1);
  const Scene scene = doubling_panes(32);
  const KdTree tree = build_kd_tree(scene, pool);
  const View view = make_view({{0, 0, 0}, {1, 0.1, 0.2}, {0, 1, 0}, 0.5}, dvec3(0), kTile_px, kTile_px);
  for (const int depth : {0, 1, 2, 5, 10}) {
    const TraceJob job{scene, view, {{{dvec3(0, 1, 0), vec3(1)}}}, false, depth};
    TraceStats stats;
    const CountingCaster caster(tree, stats);
    RayGenerations<float> generations(job, &caster);
    for (uint32_t pixel = 0; pixel < kPrimary; ++pixel)
      generations.add_primary(pixel, static_cast<int>(pixel % kTile_px), static_cast<int>(pixel / kTile_px));
    std::vector<vec3> colors(kPrimary);
    std::vector<RayGenerations<float>::PrimaryHit> hits(kPrimary);
    generations.run(colors, hits, stats);

    EXPECT_EQ(caster.taken, kPrimary * ((int64_t{2} << depth) - 1)) << "every branch was followed, depth " << depth;
    EXPECT_EQ(caster.largest_batch, std::min(kBatch, kPrimary << depth));
    EXPECT_LE(caster.longest_queue, kPrimary + 2 * kBatch * depth) << depth;
    // While generations fit batches, steps are generations: then the queue holds one of them and no more.
    if (depth <= 2) {
      EXPECT_EQ(caster.longest_queue, kPrimary << depth);
    }
    // Generation by generation the last one alone would be as long as this.
    if (depth == 10) {
      EXPECT_LT(10 * caster.longest_queue, kPrimary << depth);
    }
  }
}

// Depth 0: glass and mirrors are seen, but no further rays are fired.
TEST(RayQueue, DepthZeroFiresNothing) {
  ThreadPool pool(1);
  const Scene scene = doubling_panes(4);
  const KdTree tree = build_kd_tree(scene, pool);
  const View view = make_view({{0, 0, 0}, {1, 0.1, 0.2}, {0, 1, 0}, 0.5}, dvec3(0), kTile_px, kTile_px);
  const TraceJob job{scene, view, {{{dvec3(0, 1, 0), vec3(1)}}}, false, 0};
  TraceStats stats;
  const CountingCaster caster(tree, stats);
  RayGenerations<float> generations(job, &caster);
  for (uint32_t pixel = 0; pixel < kPrimary; ++pixel)
    generations.add_seen(pixel, 0, 0.2f, 0.2f, {1, 0, 0}, 1, 0, stats);
  std::vector<vec3> colors(kPrimary);
  generations.run(colors, {}, stats);
  EXPECT_EQ(caster.taken, 0);
  EXPECT_EQ(stats.reflection_rays + stats.refraction_rays + stats.shadow_rays, 0);
  EXPECT_EQ(stats.pixels_reflective, kPrimary);
  EXPECT_EQ(stats.pixels_refractive, kPrimary);
  EXPECT_TRUE(std::all_of(colors.begin(), colors.end(), [](const vec3& c) { return c == vec3(0); }));
}

}  // namespace
}  // namespace hybridrt
