#include "core/passes/light_frame.h"

#include <gtest/gtest.h>

#include "tests/support/trace_scenes.h"

namespace hybridrt {
namespace {

std::vector<dvec3> directions() {
  Random random(4);
  std::vector<dvec3> all = {{0, 1, 0}, {0, -1, 0}, {1, 0, 0}, {0, 0, -1}, glm::normalize(dvec3(1e-9, 1, 0))};
  for (int i = 0; i < 50; ++i) all.push_back(glm::normalize(dvec3(random.direction())));
  return all;
}

TEST(LightFrame, IsOrthonormal) {
  const Scene scene = closed_box();
  for (const dvec3& toward : directions()) {
    const LightFrame frame = fit_light_frame(scene, toward);
    EXPECT_EQ(frame.toward, toward);
    for (const dvec3& axis : {frame.x_axis, frame.y_axis}) {
      EXPECT_NEAR(glm::length(axis), 1, 1e-12);
      EXPECT_NEAR(glm::dot(axis, toward), 0, 1e-12);
    }
    EXPECT_NEAR(glm::dot(frame.x_axis, frame.y_axis), 0, 1e-12);
  }
}

TEST(LightFrame, HoldsEveryVertexAndNotMuchMore) {
  for (const NamedScene& named : all_test_scenes())
    for (const dvec3& toward : directions()) {
      if (named.scene.triangle_count() == 0) continue;
      const dmat4 unit = fit_light_frame(named.scene, toward).unit_from_scene();
      dvec3 lo(1), hi(0);
      for (uint32_t triangle = 0; triangle < named.scene.triangle_count(); ++triangle)
        for (int corner = 0; corner < 3; ++corner) {
          const dvec3 p(unit * dvec4(dvec3(named.scene.vertex(triangle, corner)), 1));
          lo = glm::min(lo, p);
          hi = glm::max(hi, p);
        }
      for (int axis = 0; axis < 3; ++axis) {
        ASSERT_GT(lo[axis], 0) << named.name;
        ASSERT_LT(hi[axis], 1) << named.name;
      }
      EXPECT_GT(std::max(hi.x - lo.x, hi.y - lo.y), 0.9) << named.name << ": most of the map is empty";
    }
}

TEST(LightFrame, DepthGrowsAwayFromTheLight) {
  const Scene scene = closed_box();
  for (const dvec3& toward : directions()) {
    const dmat4 unit = fit_light_frame(scene, toward).unit_from_scene();
    const dvec4 near = unit * dvec4(dvec3(0.5) + 0.1 * toward, 1), far = unit * dvec4(dvec3(0.5) - 0.1 * toward, 1);
    EXPECT_LT(near.z, far.z);
    EXPECT_NEAR(near.x, far.x, 1e-12);
    EXPECT_NEAR(near.y, far.y, 1e-12);
  }
}

TEST(LightFrame, FlatScenesHaveAVolume) {
  Scene flat;
  add_triangle(flat, {-1, 0, -1}, {1, 0, -1}, {0, 0, 1});
  for (const dvec3& toward : directions()) {
    const LightFrame frame = fit_light_frame(flat, toward);
    const dvec3 size = frame.hi - frame.lo;
    for (int axis = 0; axis < 3; ++axis) EXPECT_GT(size[axis], 0);
    const dmat4 unit = frame.unit_from_scene();
    for (int column = 0; column < 4; ++column) EXPECT_TRUE(all_finite(dvec3(unit[column])));
  }
}

TEST(LightFrame, UnusedVerticesDoNotCount) {
  Scene scene = closed_box();
  const LightFrame before = fit_light_frame(scene, {0, 1, 0});
  scene.positions.push_back(vec3(1000));
  const LightFrame after = fit_light_frame(scene, {0, 1, 0});
  EXPECT_EQ(before.lo, after.lo);
  EXPECT_EQ(before.hi, after.hi);
}

}  // namespace
}  // namespace hybridrt
