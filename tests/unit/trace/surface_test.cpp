// shaders/surface.glsl as C++ against values known on paper: the GPU tests only show that GLSL means the
// same.

#include "core/trace/surface.h"

#include <gtest/gtest.h>

#include "tests/support/trace_scenes.h"

namespace hybridrt {
namespace {

void expect_near(const dvec3& actual, const dvec3& expected, double bound = 1e-12) {
  for (int i = 0; i < 3; ++i) EXPECT_NEAR(actual[i], expected[i], bound) << "component " << i;
}

struct Phong {
  dvec3 kd{0.5, 0.4, 0.3}, ks{0.2, 0.3, 0.4}, ke{0};
  double ns = 8, opacity = 1;
  dvec3 normal{0, 0, 1}, to_eye{0, 0, 1}, to_light{0, 0, 1}, ambient{0.1, 0.2, 0.3}, light{1, 2, 3};

  dvec3 color() const {
    return phong_unlit(kd, ke, opacity, ambient) + phong_light(kd, ks, ns, opacity, normal, to_eye, to_light, light);
  }
};

TEST(Phong, LightAndEyeAlongTheNormal) {
  const Phong p;
  expect_near(p.color(), p.ambient * p.kd + p.light * (p.kd + p.ks));
}

TEST(Phong, SixtyDegrees) {
  Phong p;
  p.to_light = {std::sqrt(0.75), 0, 0.5};
  // Half way between is 30 degrees off the normal.
  expect_near(p.color(), p.ambient * p.kd + p.light * (0.5 * p.kd + std::pow(std::sqrt(0.75), 8) * p.ks));
}

TEST(Phong, ShadowLeavesAmbientAndEmission) {
  Phong p;
  p.ke = {0.01, 0.02, 0.03};
  const dvec3 dark = p.ke + p.ambient * p.kd;
  expect_near(phong_unlit(p.kd, p.ke, p.opacity, p.ambient), dark);
  p.to_light = {0, 0, -1};
  expect_near(p.color(), dark);
  p.to_light = {1, 0, 0};
  expect_near(p.color(), dark);
}

TEST(Phong, OpacityDimsTheDiffusePartOnly) {
  Phong p;
  p.opacity = 0.25;
  expect_near(p.color(), 0.25 * (p.ambient * p.kd) + p.light * (0.25 * p.kd + p.ks));
}

TEST(Phong, ExponentZeroAndOppositeEye) {
  Phong p;
  p.ns = 0;
  p.to_light = {std::sqrt(0.75), 0, 0.5};
  expect_near(p.color(), p.ambient * p.kd + p.light * 0.5 * p.kd);  // no highlight
  p.to_eye = -p.to_light;                                           // no half vector
  EXPECT_TRUE(all_finite(p.color()));
}

TEST(ClampedBarycentrics, FindThePointOnTheRay) {
  Random random(14);
  for (int i = 0; i < 2000; ++i) {
    const dvec3 p[3] = {dvec3(random.in_cube(-5, 5)), dvec3(random.in_cube(-5, 5)), dvec3(random.in_cube(-5, 5))};
    dvec3 weights(random.unit(), random.unit(), random.unit());
    weights /= weights.x + weights.y + weights.z;
    const dvec3 point = weights.x * p[0] + weights.y * p[1] + weights.z * p[2];
    // How much a relative error of the ray's direction moves the weights.
    const double volume = std::abs(glm::dot(glm::cross(p[1] - p[0], p[2] - p[0]), point));
    if (!(volume > 0.1)) continue;
    expect_near(clamped_barycentrics(p[0], p[1], p[2], double(random.between(0.1f, 9)) * point), weights, 1e-10);
  }
}

TEST(ClampedBarycentrics, PullWhatMissesOntoTheTriangle) {
  const dvec3 p0(0, 0, -1), p1(1, 0, -1), p2(0, 1, -1);
  expect_near(clamped_barycentrics(p0, p1, p2, dvec3(-0.1, 0.25, -1)), {0.75, 0, 0.25});
  expect_near(clamped_barycentrics(p0, p1, p2, dvec3(0.25, -0.1, -1)), {0.75, 0.25, 0});
  expect_near(clamped_barycentrics(p0, p1, p2, dvec3(0.75, 0.75, -1)), {0, 0.5, 0.5});
  expect_near(clamped_barycentrics(p0, p1, p2, dvec3(-1, -1, -1)), {1, 0, 0});
  expect_near(clamped_barycentrics(p0, p1, p2, dvec3(3, -1, -1)), {0, 1, 0});
}

TEST(ClampedBarycentrics, SeenEdgeOn) {
  expect_near(clamped_barycentrics(dvec3(0, 0, -1), dvec3(0, 1, -1), dvec3(0, 0, -2), dvec3(0, 0.5, -1)),
              dvec3(1.0 / 3));
}

TEST(Directions, TurnAndNormalise) {
  expect_near(turned_toward(dvec3(0, 1, 0), dvec3(1, 2, 3)), {0, 1, 0});
  expect_near(turned_toward(dvec3(0, -1, 0), dvec3(1, 2, 3)), {0, 1, 0});
  expect_near(normalized_or(dvec3(0, 3, 4), dvec3(1, 0, 0)), {0, 0.6, 0.8});
  expect_near(normalized_or(dvec3(0), dvec3(1, 0, 0)), {1, 0, 0});
}

}  // namespace
}  // namespace hybridrt
