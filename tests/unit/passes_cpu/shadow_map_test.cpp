// Pass 1 on the CPU against every triangle at every texel, in double precision.

#include "core/passes_cpu/shadow_map.h"

#include <cmath>
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <hwy/targets.h>

#include "core/passes/receiver_hull.h"
#include "core/passes_cpu/receiver_depths.h"
#include "core/procedural/spheres.h"
#include "core/trace/holes.h"
#include "tests/support/raster_views.h"
#include "tests/support/textured_scenes.h"

namespace hybridrt {
namespace {

/// What the map may hold at a place: the nearest depth of what certainly covers it, and of that and what its reach may
/// touch.
struct Limits {
  double nearest = 1, farthest = 1;
};

/// A triangle by homogeneous coordinates, whatever its w.
struct OracleTriangle {
  uint32_t number;
  dvec3 edge[3];  ///< barycentric weights over w
  double norm[3];
  dvec3 depth;

  OracleTriangle(const Scene& scene, const ShadowMapFit& fit, int size_px, uint32_t triangle) : number(triangle) {
    dvec3 q[3];
    dvec3 z;
    for (int k = 0; k < 3; ++k) {
      const dvec4 c = fit.map_from_origin * dvec4(dvec3(scene.vertex(triangle, k)) - fit.origin, 1);
      q[k] = dvec3(c.x * size_px, c.y * size_px, c.w), z[k] = c.z;
    }
    const double volume = glm::dot(q[0], glm::cross(q[1], q[2]));
    depth = dvec3(0);
    for (int k = 0; k < 3; ++k) {
      edge[k] = glm::cross(q[(k + 1) % 3], q[(k + 2) % 3]) / volume;  // not finite if degenerate: covers nothing
      norm[k] = std::abs(edge[k].x) + std::abs(edge[k].y);
      depth += z[k] * edge[k];
    }
  }

  void grow(Limits& limits, const Scene& scene, const dvec3& place) const {
    constexpr double kMargin_px = 2 * kReach_px;
    const dvec3 weights(glm::dot(edge[0], place), glm::dot(edge[1], place), glm::dot(edge[2], place));
    const double inside = std::min({weights.x / norm[0], weights.y / norm[1], weights.z / norm[2]});
    if (!(inside >= -kMargin_px)) return;
    const double total = weights.x + weights.y + weights.z;
    if (scene.has_holes() && inside > kMargin_px &&
        is_hole(*scene.textures, number, weights.y / total, weights.z / total))
      return;
    const double error = 2e-6 + 4 * kReach_px * (std::abs(depth.x) + std::abs(depth.y));
    limits.nearest = std::min(limits.nearest, glm::dot(depth, place) - error);
    if (inside > kMargin_px) limits.farthest = std::min(limits.farthest, glm::dot(depth, place) + error);
  }
};

/// Texels of the map that hold what no triangle explains.
int wrong_texels(const Scene& scene, const ShadowMapFit& fit, int size_px, ThreadPool& pool) {
  ShadowMapMemory memory;
  std::vector<float> depth(static_cast<size_t>(size_px) * size_px);
  draw_shadow_map(scene, fit, size_px, pool, memory, depth);
  std::vector<OracleTriangle> triangles;
  for (uint32_t t = 0; t < scene.triangle_count(); ++t) triangles.emplace_back(scene, fit, size_px, t);
  int wrong = 0;
  for (int y = 0; y < size_px; ++y)
    for (int x = 0; x < size_px; ++x) {
      Limits limits;
      for (const OracleTriangle& triangle : triangles) triangle.grow(limits, scene, {x + 0.5, y + 0.5, 1});
      const double drawn = depth[static_cast<size_t>(y) * size_px + x];
      wrong += !(drawn >= std::max(limits.nearest, -1.001) && drawn <= limits.farthest);
    }
  return wrong;
}

/// What a view of a scene sees, as the renderer fits a warped map to it.
ShadowMapFit warped_fit(const Scene& scene, const LightFrame& light, const View& view, int size_px, ThreadPool& pool) {
  const Clusters clusters = make_clusters(scene, pool);
  const std::vector<uint32_t> ids = rasterized_ids(scene, clusters, view, pool);
  std::vector<vec2> blocks(static_cast<size_t>(receiver_blocks(view.width_px)) * receiver_blocks(view.height_px));
  const double near_distance = 1e-9;
  receiver_depths(scene, view, near_distance, ids, pool, blocks);
  return fit_shadow_map(light, view, receiver_hull(view, near_distance, blocks), size_px);
}

std::vector<NamedScene> map_scenes() {
  return {{"Soup", random_soup(41, 300, 0.4f)},
          {"SmallTriangles", random_soup(42, 1500, 0.05f)},
          {"Grid", regular_grid(5)},
          {"Coplanar", coplanar_field(43, 100)},
          {"Slivers", slivers(44, 300)},
          {"Degenerates", with_degenerates(45)},
          {"Sphere", closed_sphere(24, 12)},
          {"HugeAndSmall", huge_and_small(46)},
          {"Spheres", make_spheres({800, 0})},
          {"Holes", with_random_holes(random_soup(47, 150, 0.6f), 48)}};
}

class ShadowMapOfCpu : public testing::TestWithParam<NamedScene> {};

TEST_P(ShadowMapOfCpu, HoldsTheNearestDepthAtEveryTexel) {
  const Scene& scene = GetParam().scene;
  ThreadPool pool(2);
  Random random(2005);
  for (int i = 0; i < 6; ++i) {
    const int size_px = 40 + 50 * (i % 3);  // one tile and several, their edges off the tiles' edges
    const LightFrame light = fit_light_frame(scene, dvec3(random.direction()));
    ASSERT_EQ(wrong_texels(scene, uniform_shadow_map(light, size_px), size_px, pool), 0) << "uniform, " << i;
    const ShadowMapFit fit = warped_fit(scene, light, random_view(scene, random), size_px, pool);
    ASSERT_EQ(wrong_texels(scene, fit, size_px, pool), 0) << "warped, " << i;
  }
}

INSTANTIATE_TEST_SUITE_P(Scenes, ShadowMapOfCpu, testing::ValuesIn(map_scenes()), test_name);

/// In the scene's middle and level, so that much lies behind the pole of the warp.
View level_view(const Scene& scene) {
  const dvec3 middle(scene.bounds.center());
  return make_view({middle, middle + dvec3(1, -0.2, 0.3), {0, 1, 0}, 0.9}, dvec3(0), 96, 64);
}

std::vector<float> map_of(const Scene& scene, const ShadowMapFit& fit, int size_px, int threads) {
  ThreadPool pool(threads);
  ShadowMapMemory memory;
  std::vector<float> depth(static_cast<size_t>(size_px) * size_px);
  draw_shadow_map(scene, fit, size_px, pool, memory, depth);
  return depth;
}

TEST(ShadowMapOfCpu, TrianglesReachOverThePole) {
  const Scene scene = random_soup(49, 200, 3.0f);
  ThreadPool pool(2);
  const ShadowMapFit fit =
      warped_fit(scene, fit_light_frame(scene, glm::normalize(dvec3(0.1, 1, 0.2))), level_view(scene), 100, pool);
  int over = 0;
  for (uint32_t t = 0; t < scene.triangle_count(); ++t) {
    int behind = 0;
    for (int k = 0; k < 3; ++k)
      behind += (fit.map_from_origin * dvec4(dvec3(scene.vertex(t, k)) - fit.origin, 1)).w < 0;
    over += behind == 1 || behind == 2;
  }
  EXPECT_GT(over, 20);
  EXPECT_EQ(wrong_texels(scene, fit, 100, pool), 0);
}

TEST(ShadowMapOfCpu, IsTheSameForAnyNumberOfThreads) {
  const Scene scene = with_random_holes(random_soup(50, 4000, 0.1f), 51);
  ThreadPool pool(2);
  const ShadowMapFit fit =
      warped_fit(scene, fit_light_frame(scene, glm::normalize(dvec3(0.4, 1, 0.2))), level_view(scene), 500, pool);
  const std::vector<float> one = map_of(scene, fit, 500, 1);
  for (int round = 0; round < 20; ++round) ASSERT_EQ(one, map_of(scene, fit, 500, 4)) << round;
}

TEST(ShadowMapOfCpu, IsTheSameUnderEveryInstructionSet) {
  const Scene scene = random_soup(52, 4000, 0.1f);
  const ShadowMapFit fit = uniform_shadow_map(fit_light_frame(scene, glm::normalize(dvec3(0.4, 1, 0.2))), 300);
  const std::vector<float> chosen = map_of(scene, fit, 300, 1);
  for (const int64_t target : hwy::SupportedAndGeneratedTargets()) {
    hwy::SetSupportedTargetsForTest(target);
    hwy::GetChosenTarget().Update(hwy::SupportedTargets());
    EXPECT_EQ(chosen, map_of(scene, fit, 300, 1)) << hwy::TargetName(target);
  }
  hwy::SetSupportedTargetsForTest(0);
  hwy::GetChosenTarget().Update(hwy::SupportedTargets());
}

/// A sheet of `cells` squared squares over 0..1, in two triangles each; corners within are moved by up to `jitter`
/// squares.
Scene sheet(int cells, float jitter) {
  Random random(53);
  std::vector<vec3> corners;
  for (int y = 0; y <= cells; ++y)
    for (int x = 0; x <= cells; ++x)
      corners.push_back(vec3(x + random.between(-jitter, jitter), y + random.between(-jitter, jitter), 0) /
                        float(cells));
  const auto at = [&](int x, int y) { return corners[static_cast<size_t>(y) * (cells + 1) + x]; };
  Scene scene;
  for (int y = 0; y < cells; ++y)
    for (int x = 0; x < cells; ++x) {
      add_triangle(scene, at(x, y), at(x + 1, y), at(x + 1, y + 1));
      add_triangle(scene, at(x, y), at(x + 1, y + 1), at(x, y + 1));
    }
  return scene;
}

// Wherever texels' centres fall: on corners and edges too.
TEST(ShadowMapOfCpu, ASheetHasNoGaps) {
  for (const int cells : {7, 64, 100})
    for (const float jitter : {0.0f, 0.3f})
      for (const int size_px : {cells, 2 * cells, 333, 600})
        for (const double shift_texels : {0.0, 0.25, 0.5}) {
          const Scene scene = sheet(cells, jitter);
          ShadowMapFit fit;
          fit.origin = dvec3(-shift_texels / size_px, -shift_texels / size_px, 0.5);
          const std::vector<float> depth = map_of(scene, fit, size_px, 1);
          const int margin = size_px / cells + 2;
          for (int y = margin; y < size_px - margin; ++y)
            for (int x = margin; x < size_px - margin; ++x)
              ASSERT_NEAR(depth[static_cast<size_t>(y) * size_px + x], -0.5, 1e-6)
                  << cells << ' ' << jitter << ' ' << size_px << ": " << x << ' ' << y;
        }
}

TEST(ShadowMapOfCpu, NumbersThatAreNoneAreLeftOut) {
  const float none = std::nanf(""), infinite = std::numeric_limits<float>::infinity();
  Scene scene = closed_sphere(12, 6);
  const ShadowMapFit fit = uniform_shadow_map(fit_light_frame(scene, {0, 1, 0}), 64);
  const std::vector<float> before = map_of(scene, fit, 64, 2);
  for (const float bad : {none, infinite, -infinite, 3e38f})
    for (int axis = 0; axis < 3; ++axis) {
      Scene with = scene;
      vec3 corner(0);
      corner[axis] = bad;
      add_triangle(with, corner, vec3(0.1f), {0.2f, 0.1f, 0});
      const std::vector<float> depth = map_of(with, fit, 64, 2);
      for (size_t i = 0; i < depth.size(); ++i) ASSERT_LE(depth[i], before[i]) << bad;  // false for NaN
    }
  EXPECT_EQ(map_of(Scene(), fit, 64, 2), std::vector<float>(64 * 64, 1.0f));
}

}  // namespace
}  // namespace hybridrt
