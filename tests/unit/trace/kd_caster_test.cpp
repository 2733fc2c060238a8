#include "core/trace/kd_caster.h"

#include <cstring>
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <hwy/targets.h>

#include "tests/support/brute_force.h"
#include "tests/support/trace_scenes.h"

namespace hybridrt {
namespace {

template <typename Real>
bool same_bits(const Hit<Real>& a, const Hit<Real>& b) {
  return std::memcmp(&a.t, &b.t, sizeof a.t) == 0 && std::memcmp(&a.u, &b.u, sizeof a.u) == 0 &&
         std::memcmp(&a.v, &b.v, sizeof a.v) == 0 && a.triangle == b.triangle;
}

template <typename Real>
std::string text(const Ray<Real>& ray, const Hit<Real>& hit) {
  return fmt::format("origin {} {} {} dir {} {} {} t ({}, {}): hit {} t {} u {} v {}", ray.origin.x, ray.origin.y,
                     ray.origin.z, ray.dir.x, ray.dir.y, ray.dir.z, ray.t_min, ray.t_max, int(hit.triangle), hit.t,
                     hit.u, hit.v);
}

template <typename Real>
std::vector<Hit<Real>> closest(const RayCaster<Real>& caster, const std::vector<Ray<Real>>& rays) {
  std::vector<Hit<Real>> hits(rays.size());
  caster.closest_hits(rays, hits);
  return hits;
}

template <typename Real>
void expect_brute_force(const RayCaster<Real>& caster, const Scene& scene, const std::vector<Ray<Real>>& rays) {
  const std::vector<Hit<Real>> hits = closest(caster, rays);
  for (size_t i = 0; i < rays.size(); ++i) {
    const Hit<Real> truth = brute_force_hit(scene, rays[i]);
    ASSERT_TRUE(same_bits(hits[i], truth)) << text(rays[i], hits[i]) << "\n against " << text(rays[i], truth);
  }
}

class KdCaster : public testing::TestWithParam<NamedScene> {
 protected:
  const Scene& scene() const { return GetParam().scene; }
  ThreadPool pool{2};
  KdTree tree = build_kd_tree(scene(), pool);
  std::vector<Ray<float>> rays = assorted_rays(scene(), 99, 6000);
};

// Not just nearly: a caster must give the same bits as testing every triangle, ties included.
TEST_P(KdCaster, EqualsBruteForceInFloat) {
  expect_brute_force(*make_kd_caster(tree, LeafKernel::scalar), scene(), rays);
}

TEST_P(KdCaster, EqualsBruteForceInDouble) {
  std::vector<Ray<double>> double_rays;
  for (const Ray<float>& ray : rays) double_rays.push_back(in_double(ray));
  expect_brute_force(*make_reference_caster(tree), scene(), double_rays);
}

TEST_P(KdCaster, EveryVectorUnitGivesTheScalarBits) {
  const auto scalar_hits = closest(*make_kd_caster(tree, LeafKernel::scalar), rays);
  const auto caster = make_kd_caster(tree, LeafKernel::simd);
  for (int64_t targets = hwy::SupportedTargets(); targets != 0; targets &= targets - 1) {
    const int64_t target = targets & -targets;
    hwy::SetSupportedTargetsForTest(target);
    hwy::GetChosenTarget().Update(hwy::SupportedTargets());
    const auto hits = closest(*caster, rays);
    std::vector<uint8_t> occluded(rays.size());
    caster->any_hits(rays, occluded);
    for (size_t i = 0; i < rays.size(); ++i) {
      ASSERT_TRUE(same_bits(hits[i], scalar_hits[i]))
          << hwy::TargetName(target) << "\n"
          << text(rays[i], hits[i]) << "\n against " << text(rays[i], scalar_hits[i]);
      ASSERT_EQ(occluded[i], hits[i].found()) << hwy::TargetName(target);
    }
  }
  hwy::SetSupportedTargetsForTest(0);
  hwy::GetChosenTarget().Update(hwy::SupportedTargets());
}

TEST_P(KdCaster, AnyHitIsWhetherThereIsAClosestHit) {
  const auto caster = make_kd_caster(tree, LeafKernel::scalar);
  const auto hits = closest(*caster, rays);
  std::vector<uint8_t> occluded(rays.size());
  caster->any_hits(rays, occluded);
  for (size_t i = 0; i < rays.size(); ++i) ASSERT_EQ(occluded[i], hits[i].found());
}

TEST_P(KdCaster, RangeIsOpen) {
  const auto caster = make_kd_caster(tree, LeafKernel::simd);
  auto hits = closest(*caster, rays);
  std::vector<Ray<float>> up_to_hit, from_hit;
  for (size_t i = 0; i < rays.size(); ++i) {
    if (!hits[i].found()) continue;
    EXPECT_GT(hits[i].t, rays[i].t_min);
    EXPECT_LT(hits[i].t, rays[i].t_max);
    up_to_hit.push_back({rays[i].origin, rays[i].dir, rays[i].t_min, hits[i].t});
    from_hit.push_back({rays[i].origin, rays[i].dir, hits[i].t, rays[i].t_max});
  }
  for (const Hit<float>& hit : closest(*caster, up_to_hit)) ASSERT_FALSE(hit.found());
  hits = closest(*caster, from_hit);
  for (size_t i = 0; i < hits.size(); ++i) {
    ASSERT_GT(hits[i].t, from_hit[i].t_min);  // infinity where nothing follows
  }
}

INSTANTIATE_TEST_SUITE_P(Scenes, KdCaster, testing::ValuesIn(all_test_scenes()), test_name);

TEST(KdCasterRays, UntraceableRaysHitNothing) {
  ThreadPool pool(1);
  const KdTree tree = build_kd_tree(closed_box(), pool);
  const float nan = std::numeric_limits<float>::quiet_NaN(), inf = std::numeric_limits<float>::infinity();
  const std::vector<Ray<float>> rays = {{vec3(0.5f), vec3(0)},
                                        {vec3(0.5f), vec3(nan, 0, 1)},
                                        {vec3(0.5f), vec3(0, inf, 1)},
                                        {vec3(nan, 0.5f, 0.5f), vec3(0, 0, 1)},
                                        {vec3(0.5f, inf, 0.5f), vec3(0, 0, 1)},
                                        {vec3(0.5f), vec3(1e-45f, 0, 0)},
                                        {vec3(0.5f), vec3(0, 0, 1), nan, inf},
                                        {vec3(0.5f), vec3(0, 0, 1), 0, nan},
                                        {vec3(0.5f), vec3(0, 0, 1), 2, 1}};
  for (const LeafKernel kernel : {LeafKernel::scalar, LeafKernel::simd})
    for (const Hit<float>& hit : closest(*make_kd_caster(tree, kernel), rays)) EXPECT_FALSE(hit.found());
}

TEST(KdCasterRays, BarycentricWeightsNameTheHitPoint) {
  ThreadPool pool(1);
  const Scene scene = closed_sphere(24, 12);
  const KdTree tree = build_kd_tree(scene, pool);
  const std::vector<Ray<float>> rays = assorted_rays(scene, 5, 2000);
  const auto hits = closest(*make_kd_caster(tree, LeafKernel::simd), rays);
  for (size_t i = 0; i < rays.size(); ++i) {
    if (!hits[i].found()) continue;
    const uint32_t hit = hits[i].triangle;
    const vec3 by_weights = scene.vertex(hit, 0) * (1 - hits[i].u - hits[i].v) + scene.vertex(hit, 1) * hits[i].u +
                            scene.vertex(hit, 2) * hits[i].v;
    EXPECT_LT(glm::distance(by_weights, rays[i].origin + hits[i].t * rays[i].dir), 1e-5f);
  }
}

}  // namespace
}  // namespace hybridrt
