#include "core/render/motion.h"

#include <gtest/gtest.h>

#include "core/scene/view.h"
#include "tests/support/trace_scenes.h"

namespace hybridrt {
namespace {

TEST(CameraMotion, GoesOnceAroundWithoutRepeatingAFrame) {
  CameraMotion motion;
  motion.course = default_orbit(boxed(vec3(-1), vec3(1)), {vec3(-1), vec3(1)}, 1, kPi / 4);
  motion.sequence = {1, 8, 1};
  for (int frame = 1; frame <= 8; ++frame) {
    const dvec3 eye = camera_at(motion, frame).eye_world, next = camera_at(motion, frame + 1).eye_world;
    EXPECT_NEAR(glm::length(eye), glm::length(next), 1e-12);
    // An eighth of a turn about the up axis.
    EXPECT_NEAR(
        glm::dot(dvec2(eye.x, eye.z), dvec2(next.x, next.z)) / glm::dot(dvec2(eye.x, eye.z), dvec2(eye.x, eye.z)),
        std::sqrt(0.5), 1e-12);
    EXPECT_EQ(eye.y, next.y);
  }
  EXPECT_NEAR(glm::distance(camera_at(motion, 9).eye_world, camera_at(motion, 1).eye_world), 0, 1e-12);
}

TEST(CameraMotion, StillCameraStandsStill) {
  CameraMotion motion;
  motion.course = Camera{{1, 2, 3}, {0, 0, 0}, {0, 1, 0}, 1};
  motion.sequence = {1, 100, 1};
  EXPECT_EQ(camera_at(motion, 1).eye_world, camera_at(motion, 77).eye_world);
}

TEST(LightMotion, FollowingLightIsStillAsSeenFromTheCamera) {
  Orbit orbit;
  orbit.radius = 5, orbit.height = 2;
  const CameraMotion motion{orbit, {1, 8, 1}};
  LightMotion light;
  light.lights = {{glm::normalize(dvec3(1, 2, 3))}};
  light.mode = LightMode::with_camera;
  const auto seen = [&](int frame) {
    const View view = make_view(camera_at(motion, frame), dvec3(0), 4, 3);
    const dvec3 toward = lights_at(light, motion, frame)[0].toward;
    return dvec3(glm::dot(view.right, toward), glm::dot(view.up, toward), glm::dot(view.forward, toward));
  };
  EXPECT_EQ(lights_at(light, motion, 1)[0].toward, light.lights[0].toward);
  for (int frame = 2; frame <= 8; ++frame) {
    EXPECT_LT(glm::distance(seen(frame), seen(1)), 1e-12) << frame;
    EXPECT_GT(glm::distance(lights_at(light, motion, frame)[0].toward, light.lights[0].toward), 0.1) << "it moved";
    EXPECT_NEAR(lights_at(light, motion, frame)[0].toward.y, light.lights[0].toward.y, 1e-12)
        << "a turn about the up axis";
  }
  light.mode = LightMode::fixed;
  EXPECT_EQ(lights_at(light, motion, 5)[0].toward, light.lights[0].toward);
}

TEST(LightMotion, KeysMoveTheFirstAndTheCameraTurnsAll) {
  CameraPath path;
  path.keys = {{1, {{5, 1, 0}, {0, 0, 0}, {0, 1, 0}, 1}, dvec3(1, 0, 0)},
               {5, {{0, 1, 5}, {0, 0, 0}, {0, 1, 0}, 1}, dvec3(0, 1, 0)}};
  const CameraMotion motion{path, {1, 5, 1}};
  LightMotion lights;
  lights.lights = {{dvec3(1, 0, 0), vec3(1)}, {dvec3(0, 0.6, 0.8), vec3(0.5f), false}};

  lights.mode = LightMode::with_path;
  EXPECT_TRUE(lights_move(lights, motion));
  const auto keyed = lights_at(lights, motion, 5);
  EXPECT_EQ(keyed[0].toward, dvec3(0, 1, 0));
  EXPECT_EQ(keyed[1].toward, dvec3(0, 0.6, 0.8));

  lights.mode = LightMode::with_camera;
  EXPECT_TRUE(lights_move(lights, motion));
  const auto turned = lights_at(lights, motion, 5);  // a quarter turn about y: x to z, z to -x
  EXPECT_LT(glm::distance(turned[0].toward, dvec3(0, 0, 1)), 1e-12);
  EXPECT_LT(glm::distance(turned[1].toward, dvec3(-0.8, 0.6, 0)), 1e-12);
  EXPECT_EQ(turned[1].color, vec3(0.5f));
  EXPECT_FALSE(turned[1].casts_shadow);

  for (const LightMode mode : {LightMode::with_path, LightMode::with_camera}) {
    const LightMotion none{{}, mode};
    EXPECT_FALSE(lights_move(none, motion));
    EXPECT_TRUE(lights_at(none, motion, 3).empty());
  }
}

}  // namespace
}  // namespace hybridrt
