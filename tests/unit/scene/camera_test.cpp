// The default camera and light: any OBJ gives a good picture unaided.

#include "core/scene/camera.h"

#include <gtest/gtest.h>

#include "core/procedural/spheres.h"
#include "core/render/default_view.h"
#include "core/render/render_job.h"
#include "core/scene/view.h"
#include "tests/support/trace_scenes.h"

namespace hybridrt {
namespace {

constexpr double kFov_rad = 0.7853981633974483;

/// How far from the middle of the picture the outermost vertex lies; 1 is the picture's edge. Infinite when
/// one is behind the camera.
double outermost(const Scene& scene, const View& view) {
  double largest = 0;
  for (const vec3& position : scene.positions) {
    const dvec3 p = dvec3(position) - view.eye;
    const double depth = glm::dot(p, view.forward);
    if (depth <= 0) return std::numeric_limits<double>::infinity();
    largest = std::max({largest, std::abs(glm::dot(p, view.right)) / depth / view.tan_half_width,
                        std::abs(glm::dot(p, view.up)) / depth / view.tan_half_height});
  }
  return largest;
}

struct Shape {
  const char* name;
  Scene scene;
};

std::vector<Shape> shapes() {
  Scene far = boxed({-1, -2, -3}, {1, 2, 3});
  far.origin_world = {1e7, -1e6, 1e5};
  return {{"cube", boxed(vec3(-1), vec3(1))},
          {"slab", boxed({-10, 0, -7}, {10, 0.1f, 7})},
          {"tower", boxed({0, 0, 0}, {1, 30, 1})},
          {"needle", boxed({0, 0, 0}, {100, 0.01f, 0.01f})},
          {"sphere", closed_sphere(16, 8)},
          {"spheres", make_spheres({1000, 0})},
          {"tiny", boxed(vec3(-1e-6f), vec3(1e-6f))},
          {"huge", boxed(vec3(-1e11f), vec3(1e11f))},
          {"off", boxed({1000, 50, -3}, {1004, 51, 9})},
          {"far", far}};
}

TEST(DefaultOrbit, KeepsTheWholeSceneInViewFromAllAround) {
  for (const Shape& shape : shapes())
    for (double aspect : {0.25, 0.75, 1.0, 4.0 / 3, 3.0})
      for (double fov : {0.1, kFov_rad, 1.4, 2.8}) {
        const Orbit orbit = default_orbit(shape.scene, shape.scene.bounds, aspect, fov);
        double widest = 0;
        for (int step = 0; step < 72; ++step) {
          const View view = make_view(camera_on_orbit(orbit, step / 72.0), shape.scene.origin_world,
                                      static_cast<int>(std::lround(600 * aspect)), 600);
          widest = std::max(widest, outermost(shape.scene, view));
        }
        EXPECT_LE(widest, 1.0) << shape.name << ", aspect " << aspect << ", fov " << fov;
        // "As near as": the scene fills a good part of the picture at some angle.
        EXPECT_GE(widest, fov < 2 ? 0.8 : 0.5) << shape.name << ", aspect " << aspect << ", fov " << fov;
      }
}

TEST(DefaultOrbit, LooksSlightlyFromAbove) {
  const Orbit orbit = default_orbit(boxed(vec3(-1), vec3(1)), {vec3(-1), vec3(1)}, 4.0 / 3, kFov_rad);
  const double elevation_deg = std::atan2(orbit.height, orbit.radius) * 180 / kPi;
  EXPECT_GT(elevation_deg, 5);
  EXPECT_LT(elevation_deg, 45);
  EXPECT_EQ(orbit.fov_y_rad, kFov_rad);
  EXPECT_NEAR(orbit.target_world.x, 0, 1e-9);
  EXPECT_NEAR(orbit.target_world.z, 0, 1e-9);
}

TEST(DefaultOrbit, SceneOfOnePointStillHasACamera) {
  const Orbit orbit = default_orbit(boxed(vec3(3), vec3(3)), {vec3(3), vec3(3)}, 1, kFov_rad);
  EXPECT_NO_THROW(make_view(camera_on_orbit(orbit, 0.3), dvec3(0), 8, 8));
}

}  // namespace
}  // namespace hybridrt
