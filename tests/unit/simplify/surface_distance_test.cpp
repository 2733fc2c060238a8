// The measured distance against distances known on paper and against every triangle tried.

#include "core/simplify/surface_distance.h"

#include <gtest/gtest.h>

#include "core/trace/closest_point.h"
#include "tests/support/mesh_test.h"
#include "tests/support/simplify_scenes.h"
#include "tests/support/trace_scenes.h"

namespace hybridrt {
namespace {

TEST(TriangleDistance, KnownOnPaper) {
  const dvec3 a(0, 0, 0), b(4, 0, 0), c(0, 4, 0);
  EXPECT_EQ(closest_on_triangle({1, 1, 5}, a, b, c), dvec3(1, 1, 0));    // over the inside
  EXPECT_EQ(closest_on_triangle({-1, -2, 0}, a, b, c), dvec3(0, 0, 0));  // beyond each corner
  EXPECT_EQ(closest_on_triangle({9, -1, 1}, a, b, c), dvec3(4, 0, 0));
  EXPECT_EQ(closest_on_triangle({-1, 9, 1}, a, b, c), dvec3(0, 4, 0));
  EXPECT_EQ(closest_on_triangle({1, -3, 2}, a, b, c), dvec3(1, 0, 0));  // beyond each edge
  EXPECT_EQ(closest_on_triangle({-3, 1, 2}, a, b, c), dvec3(0, 1, 0));
  EXPECT_EQ(closest_on_triangle({4, 4, 2}, a, b, c), dvec3(2, 2, 0));
  EXPECT_EQ(closest_on_triangle({1, 1, 0}, a, b, b), dvec3(1, 0, 0));  // no area
  EXPECT_EQ(squared_distance_to_triangle({1, 1, 5}, a, a, a), 27);
}

TEST(TriangleDistance, NoPointOfTheTriangleIsNearer) {
  Random random(7);
  for (int i = 0; i < 2000; ++i) {
    const dvec3 a(random.in_cube(-1, 1)), b(random.in_cube(-1, 1)), c(random.in_cube(-1, 1));
    const dvec3 p(random.in_cube(-2, 2));
    const double squared = squared_distance_to_triangle(p, a, b, c);
    for (int j = 0; j < 50; ++j) {
      double u = random.unit(), v = random.unit();
      if (u + v > 1) u = 1 - u, v = 1 - v;
      const dvec3 gap = p - ((1 - u - v) * a + u * b + v * c);
      ASSERT_LE(squared, glm::dot(gap, gap) + 1e-12);
    }
  }
}

TEST(ClosestPoints, AsBruteForce) {
  const Scene scene = sphere_scene(20, 30);
  const ClosestPoints points(scene, 2);
  Random random(11);
  for (int i = 0; i < 1000; ++i) {
    const dvec3 p(random.in_cube(-3, 3));
    const double expected = brute_force_distance(scene, p);
    for (const double likely : {0.001, 100.0}) {
      const ClosestPoint found = points.nearest(p, likely);
      EXPECT_NEAR(found.distance, expected, 1e-6 * expected);
      EXPECT_LT(found.triangle, scene.triangle_count());
    }
  }
}

TEST(SurfaceDistance, OfShiftedSheets) {
  const Scene low = terrain_scene(4, [](float, float) { return 0.f; });
  Scene high = terrain_scene(7, [](float, float) { return 0.25f; });
  ThreadPool pool(2);
  const SurfaceDistance distance = measure_distance(low, even_bounds(low, 0.5f), high, pool);
  EXPECT_NEAR(distance.from_original, 0.25, 1e-12);
  EXPECT_NEAR(distance.from_simplified, 0.25, 1e-12);
  EXPECT_NEAR(distance.share, 0.5, 1e-12);
  EXPECT_GT(distance.samples, 1000000u);
}

TEST(SurfaceDistance, OneWayOnly) {
  Scene sheet = terrain_scene(4, [](float, float) { return 0.f; });
  Scene with_tower = sheet;
  add_cube(with_tower, {0, 0, 0});
  with_tower.bounds = compute_bounds(with_tower);
  ThreadPool pool(2);
  const SurfaceDistance added = measure_distance(sheet, even_bounds(sheet, 2), with_tower, pool);
  EXPECT_EQ(added.from_original, 0);
  EXPECT_NEAR(added.from_simplified, 1, 1e-12);
  const SurfaceDistance removed = measure_distance(with_tower, even_bounds(with_tower, 2), sheet, pool);
  EXPECT_NEAR(removed.from_original, 1, 1e-12);
  EXPECT_EQ(removed.from_simplified, 0);
}

TEST(SurfaceDistance, SaysWhereABoundIsNotKept) {
  const Scene flat = terrain_scene(8, [](float, float) { return 0.f; });
  const Scene bent = terrain_scene(8, [](float x, float) { return x > 0.7f ? x - 0.7f : 0; });
  std::vector<float> bounds = even_bounds(flat, 0.2f);
  ThreadPool pool(2);
  const SurfaceDistance distance = measure_distance(flat, bounds, bent, pool);
  EXPECT_GT(distance.share, 1);
  size_t wrong = 0, far = 0;
  for (uint32_t t = 0; t < flat.triangle_count(); ++t) {
    const float x = std::max({flat.vertex(t, 0).x, flat.vertex(t, 1).x, flat.vertex(t, 2).x});
    wrong += x < 0.7f && distance.exceeds[t];
    far += x == 1 && distance.exceeds[t];
  }
  EXPECT_EQ(wrong, 0u);
  EXPECT_EQ(far, 16u);
}

TEST(SurfaceDistance, SameForAnyNumberOfThreads) {
  const Scene a = sphere_scene(20, 30), b = sphere_scene(7, 9);
  ThreadPool one(1), four(4);
  const SurfaceDistance expected = measure_distance(a, even_bounds(a, 0.01f), b, one, 1e4);
  for (int i = 0; i < 40; ++i) {
    const SurfaceDistance found = measure_distance(a, even_bounds(a, 0.01f), b, four, 1e4);
    ASSERT_EQ(found.from_original, expected.from_original);
    ASSERT_EQ(found.from_simplified, expected.from_simplified);
    ASSERT_EQ(found.share, expected.share);
    ASSERT_EQ(found.exceeds, expected.exceeds);
  }
}

}  // namespace
}  // namespace hybridrt
