#include "core/trace/embree_caster.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "core/trace/kd_caster.h"
#include "tests/support/brute_force.h"
#include "tests/support/trace_scenes.h"

namespace hybridrt {
namespace {

/// Distance between the line of the ray and the segment from `a` to `b`.
double line_to_segment(const Ray<double>& ray, const dvec3& a, const dvec3& b) {
  const dvec3 dir = glm::normalize(ray.dir), edge = b - a, from = a - ray.origin;
  // Across the ray everything is 2-D: the nearest point of a segment to the origin.
  const dvec3 edge_across = edge - glm::dot(edge, dir) * dir, from_across = from - glm::dot(from, dir) * dir;
  const double length2 = glm::dot(edge_across, edge_across);
  const double along = length2 > 0 ? std::clamp(-glm::dot(from_across, edge_across) / length2, 0.0, 1.0) : 0;
  return glm::length(from_across + along * edge_across);
}

double line_to_outline(const Ray<double>& ray, const Scene& scene, uint32_t triangle) {
  const dvec3 a = scene.vertex(triangle, 0), b = scene.vertex(triangle, 1), c = scene.vertex(triangle, 2);
  return std::min({line_to_segment(ray, a, b), line_to_segment(ray, b, c), line_to_segment(ray, c, a)});
}

/// 32 float roundings of the largest distance in the scene.
double rounding_of(const Scene& scene, const Ray<double>& ray) {
  return 32 * 0x1p-24 * (glm::distance(dvec3(scene.bounds.center()), ray.origin) + glm::length(scene.bounds.extent()));
}

// Embree and the kd-tree round differently, so against the truth in double this counts as agreement:
//  - the same triangle,
//  - another one at the same distance, within 32 float roundings of the largest distance in the scene,
//  - a dispute about whether the nearer triangle is hit at all, if within the same bound the ray passes its outline, or
//    the hit lies at the end of the ray's range.
// A caster answers both queries alike; only Embree's packets may contradict themselves, for such rays.
void expect_agreement(const RayCaster<float>& caster, const Scene& scene, const std::vector<Ray<float>>& rays,
                      bool one_mind = true) {
  std::vector<Hit<float>> hits(rays.size());
  std::vector<uint8_t> occluded(rays.size());
  caster.closest_hits(rays, hits);
  caster.any_hits(rays, occluded);
  for (size_t i = 0; i < rays.size(); ++i) {
    const Ray<double> ray = in_double(rays[i]);
    const Hit<float>& hit = hits[i];
    const Hit<double> truth = brute_force_hit(scene, ray);
    if (hit.found() != (occluded[i] != 0)) {
      EXPECT_FALSE(one_mind) << i;
      double nearest_outline = std::numeric_limits<double>::infinity();
      for (uint32_t k = 0; k < scene.triangle_count(); ++k)
        nearest_outline = std::min(nearest_outline, line_to_outline(ray, scene, k));
      EXPECT_LE(nearest_outline, rounding_of(scene, ray)) << i;
    }
    if (hit.triangle == truth.triangle) continue;
    const double bound = rounding_of(scene, ray), t_bound = bound / glm::length(ray.dir);
    if (hit.found() && truth.found() && std::abs(hit.t - truth.t) <= t_bound) continue;
    const bool truth_is_nearer = truth.t < hit.t;
    const double t = truth_is_nearer ? truth.t : hit.t;
    if (std::abs(t - ray.t_min) <= t_bound || std::abs(t - ray.t_max) <= t_bound) continue;
    EXPECT_LE(line_to_outline(ray, scene, truth_is_nearer ? truth.triangle : hit.triangle), bound) << fmt::format(
        "ray {}: hit {} at {}, truth {} at {}", i, int(hit.triangle), hit.t, int(truth.triangle), truth.t);
  }
}

class Agreement : public testing::TestWithParam<NamedScene> {
 protected:
  const Scene& scene() const { return GetParam().scene; }
  std::vector<Ray<float>> rays = assorted_rays(scene(), 123, 6000);
};

TEST_P(Agreement, EmbreeWithTheTruth) {
  expect_agreement(*make_embree_caster(scene(), 2, EmbreeRays::single), scene(), rays);
}

TEST_P(Agreement, EmbreesPacketsWithTheTruth) {
  expect_agreement(*make_embree_caster(scene(), 2), scene(), rays, /*one_mind=*/false);
}

// These go through the tree together, the assorted ones soon one by one.
TEST_P(Agreement, EmbreesPacketsOfLikeRaysWithTheTruth) {
  std::vector<Ray<float>> bundles;
  for (size_t i = 0; i < rays.size(); i += 16)
    for (int k = 0; k < 16; ++k) {
      bundles.push_back(rays[i]);
      bundles.back().dir = glm::normalize(rays[i].dir + 1e-3f * static_cast<float>(k) * vec3(1, -1, 0.5f));
    }
  expect_agreement(*make_embree_caster(scene(), 2), scene(), bundles, /*one_mind=*/false);
}

TEST_P(Agreement, KdTreeWithTheTruth) {
  ThreadPool pool(2);
  const KdTree tree = build_kd_tree(scene(), pool);
  expect_agreement(*make_kd_caster(tree, LeafKernel::simd), scene(), rays);
}

INSTANTIATE_TEST_SUITE_P(Scenes, Agreement, testing::ValuesIn(all_test_scenes()), test_name);

// Its last position ends a page: reading 16 bytes of it would leave the vector.
TEST(EmbreeCaster, PositionsThatEndTheirMemoryAreCopied) {
  Scene tight = closed_box();
  tight.positions.shrink_to_fit();
  Scene roomy = tight;
  roomy.positions.reserve(tight.positions.size() + 1);
  const std::vector<Ray<float>> rays = assorted_rays(tight, 5, 1000);
  std::vector<Hit<float>> copied(rays.size()), lent(rays.size());
  make_embree_caster(tight, 1)->closest_hits(rays, copied);
  make_embree_caster(roomy, 1)->closest_hits(rays, lent);
  for (size_t i = 0; i < rays.size(); ++i) EXPECT_EQ(lent[i].t, copied[i].t) << i;
}

TEST(EmbreeCaster, RangeIsOpen) {
  const Scene box = closed_box();
  const auto caster = make_embree_caster(box, 1);
  const auto hit_within = [&](float t_min, float t_max) {
    const Ray<float> ray{vec3(0.5f, 0.4f, -1), vec3(0, 0, 1), t_min, t_max};
    Hit<float> hit;
    caster->closest_hits(std::span(&ray, 1), std::span(&hit, 1));
    return hit;
  };
  constexpr float kEnd = std::numeric_limits<float>::infinity();
  // Embree's t depends on the processor's instructions by a rounding.
  const float near = hit_within(0, kEnd).t, far = hit_within(1.5f, kEnd).t;
  EXPECT_NEAR(near, 1, 1e-6);
  EXPECT_NEAR(far, 2, 1e-6);
  EXPECT_FALSE(hit_within(0, near).found());
  EXPECT_EQ(hit_within(0, std::nextafter(near, kEnd)).t, near);
  EXPECT_EQ(hit_within(near, kEnd).t, far);
  EXPECT_FALSE(hit_within(far, kEnd).found());
}

/// Leaves numbers on the stack that make a ray which Embree refuses.
__attribute__((noinline)) void dirty_the_stack() {
  volatile float garbage[1 << 14];
  for (volatile float& number : garbage) number = 1e30f;
}

// With vectors of eight floats Embree traces every lane of a packet of 16 whose range is not empty.
TEST(EmbreeCaster, LanesWithoutARayAreEmpty) {
  const Scene scene = random_soup(11, 200, 0.3f);
  const auto caster = make_embree_caster(scene, 1);
  Random random(12);
  std::vector<Ray<float>> rays;
  for (int i = 0; i < 40; ++i) rays.push_back({random.in_cube(-2, 2), random.direction()});
  rays[5].dir = vec3(0);  // not traceable
  std::vector<Hit<float>> all(rays.size());
  caster->closest_hits(rays, all);
  for (size_t count = 1; count <= rays.size(); ++count) {
    std::vector<Hit<float>> hits(count);
    std::vector<uint8_t> occluded(count);
    dirty_the_stack();
    caster->closest_hits(std::span(rays).first(count), hits);
    dirty_the_stack();
    caster->any_hits(std::span(rays).first(count), occluded);
    for (size_t i = 0; i < count; ++i) {
      EXPECT_EQ(hits[i].triangle, all[i].triangle) << i;
      EXPECT_EQ(occluded[i] != 0, all[i].found()) << i;
    }
  }
}

}  // namespace
}  // namespace hybridrt
