// How far surfaces may move before a frame shows it: against projections of points that did.

#include "core/simplify/view_bounds.h"

#include <gtest/gtest.h>

#include "core/simplify/silhouette.h"
#include "tests/support/mesh_test.h"
#include "tests/support/simplify_scenes.h"
#include "tests/support/trace_scenes.h"

namespace hybridrt {
namespace {

constexpr float kFar = std::numeric_limits<float>::infinity();

View view_from(const dvec3& eye, const dvec3& target, double fov_y_deg = 50) {
  return make_view({eye, target, {0, 1, 0}, fov_y_deg * kPi / 180}, dvec3(0), 320, 240);
}

std::vector<float> bounds_of(const Scene& scene, const std::vector<Sight>& sights, double max_error_px = 1) {
  ThreadPool pool(2);
  std::vector<float> bounds = even_bounds(scene, kFar);
  narrow_bounds(scene, sights, max_error_px, bounds, pool);
  return bounds;
}

/// Where a point is in the picture, in pixels.
dvec2 projected(const View& view, const dvec3& p) {
  const dvec3 d = p - view.eye;
  const double depth = glm::dot(d, view.forward);
  return {glm::dot(d, view.right) / depth / (2 * view.tan_half_width) * view.frame_width_px,
          glm::dot(d, view.up) / depth / (2 * view.tan_half_height) * view.frame_height_px};
}

/// A triangle of side 1e-3 at a point.
Scene speck(const vec3& at) { return bare_scene({at, at + vec3(1e-3f, 0, 0), at + vec3(0, 1e-3f, 0)}, {{0, 1, 2}}); }

TEST(ViewBounds, APixelInTheMiddle) {
  const double expected = 0.5 * 10 * 2 * std::tan(25 * kPi / 180) / 240;
  EXPECT_NEAR(bounds_of(speck({0, 0, -10}), {{view_from({0, 0, 0}, {0, 0, -1}), {}}}, 0.5)[0], expected,
              0.01 * expected);
}

TEST(ViewBounds, NoMoveIsMoreThanAPixelAndSomeIsNearlyOne) {
  const View view = view_from({1, 2, 3}, {0, 1, -4}, 90);
  Random random(3);
  double largest = 0;
  for (int i = 0; i < 3000; ++i) {
    const double x = random.between(-1, 1) * view.tan_half_width, y = random.between(-1, 1) * view.tan_half_height;
    const dvec3 p = view.eye + double{random.between(0.1f, 20)} * (view.forward + x * view.right + y * view.up);
    const double bound = bounds_of(speck(vec3(p)), {{view, {}}})[0];
    for (int j = 0; j < 20; ++j) {
      const double moved = glm::length(projected(view, p + bound * dvec3(random.direction())) - projected(view, p));
      ASSERT_LE(moved, 1.0001);
      largest = std::max(largest, moved);
    }
  }
  EXPECT_GT(largest, 0.9);
}

TEST(ViewBounds, TheNearestFrameAndPointCount) {
  const Scene wall = bare_scene({{-9, 0, -9}, {9, 0, -9}, {0, 30, 9}}, {{0, 1, 2}});
  const double pixel = 2 * std::tan(25 * kPi / 180) / 240;
  std::vector<Sight> sights;
  for (double height : {3.0, 0.5, 8.0}) sights.push_back({view_from({0, -height, -9}, {0, -height, -8}), {}});
  const float bound = bounds_of(wall, sights)[0];
  EXPECT_LE(bound, 0.5 * pixel) << "the middle of an edge is nearer than any corner";
  EXPECT_GT(bound, 0.3 * pixel);
  sights.push_back({view_from({0, 0, -9}, {0, 1, 0}), {}});
  EXPECT_EQ(bounds_of(wall, sights)[0], 0) << "the eye is in the surface";
}

TEST(ViewBounds, AShadowCountsWhereItMayFall) {
  Scene scene = speck({0, 100, 0});
  scene.positions.insert(scene.positions.end(), {{-50, 0, -50}, {50, 0, -50}, {0, 0, 90}});
  scene.triangle_positions.push_back({3, 4, 5});
  scene.triangle_materials.push_back(0);
  scene.bounds = compute_bounds(scene);
  const View view = view_from({2, 1, 0}, {2, 1, -1});
  const float plain = bounds_of(scene, {{view, {}}})[0];
  const float below = bounds_of(scene, {{view, {{0, 1, 0}}}})[0];  // its shadow passes the eye at a distance of 2
  EXPECT_LT(below, plain / 30);
  EXPECT_GT(below, plain / 80);
  EXPECT_EQ(bounds_of(scene, {{view, {{0, -1, 0}}}})[0], plain) << "it falls away from the eye";
}

TEST(ViewBounds, AShadowFallsInsideTheScene) {
  const Scene scene = terrain_scene(4, [](float, float) { return 0.f; });
  const View view = view_from({0.5, -10, 0.5}, {0.5, 0, 0.6});  // below all: the shadow of what is above it
  const auto plain = bounds_of(scene, {{view, {}}}), shadowed = bounds_of(scene, {{view, {{0, 1, 0}}}});
  for (size_t t = 0; t < plain.size(); ++t) EXPECT_GT(shadowed[t], 0.5f * plain[t]);
}

TEST(ViewBounds, MirrorsAndGlassAreKept) {
  Scene scene = terrain_scene(2, [](float, float) { return 0.f; });
  scene.materials.resize(3, scene.materials[0]);
  scene.materials[1].reflect = vec3(0.5f);
  scene.materials[2].transmit = vec3(1), scene.materials[2].ni = 1.5f;
  for (uint32_t t = 0; t < scene.triangle_count(); ++t) scene.triangle_materials[t] = t % 3;
  std::vector<float> bounds = even_bounds(scene, 1);
  keep_mirrors(scene, bounds);
  for (uint32_t t = 0; t < scene.triangle_count(); ++t) EXPECT_EQ(bounds[t], t % 3 == 0 ? 1 : 0);
}

std::vector<uint8_t> mask_of(std::string_view picture) {
  std::vector<uint8_t> mask;
  for (char c : picture) mask.push_back(c == '#');
  return mask;
}

TEST(OutlineDistance, KnownOnPaper) {
  EXPECT_EQ(outline_distance(mask_of("........"), mask_of("........"), 4), 0);
  EXPECT_EQ(outline_distance(mask_of(".##..##."), mask_of(".##..##."), 4), 0);
  EXPECT_EQ(outline_distance(mask_of(".##..##."), mask_of("##..##.."), 4), 1);
  EXPECT_EQ(outline_distance(mask_of("###...."), mask_of("#......"), 7), 2);
  std::vector<uint8_t> full(49, 1), pierced = full;
  pierced[24] = 0;
  EXPECT_EQ(outline_distance(full, pierced, 7), 1);
  for (int i : {16, 17, 18, 23, 25, 30, 31, 32}) pierced[static_cast<size_t>(i)] = 0;
  EXPECT_EQ(outline_distance(full, pierced, 7), 2) << "the middle of a wider hole";
  EXPECT_EQ(outline_distance(mask_of("#......"), mask_of("#.....#"), 7), 6);
  EXPECT_EQ(outline_distance(mask_of("......."), mask_of("#......"), 7), 7) << "one has no outline";
}

}  // namespace
}  // namespace hybridrt
