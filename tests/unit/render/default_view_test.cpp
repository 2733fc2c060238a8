#include "core/render/default_view.h"

#include <gtest/gtest.h>

#include "core/scene/view.h"
#include "core/trace/embree_caster.h"
#include "tests/support/load_scene.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/trace_scenes.h"

namespace hybridrt {
namespace {

const char* const kCorners = "v -1 -1 -1\nv 1 -1 -1\nv 1 1 -1\nv -1 1 -1\nv -1 -1 1\nv 1 -1 1\nv 1 1 1\nv -1 1 1\n";
const char* const kFiveWallsInward = "f 1 2 3 4\nf 1 4 8 5\nf 2 6 7 3\nf 1 5 6 2\nf 4 3 7 8\n";  // open at z = 1
const char* const kFrontWallInward = "f 5 8 7 6\n";

DefaultView view_of(const std::string& argument) {
  ThreadPool pool(1);
  Warnings warnings;
  const Scene scene = load_scene(argument, pool, warnings);
  return choose_default_view(scene, scene.bounds, *make_embree_caster(scene, 1), 4.0 / 3, 0.8);
}

DefaultView view_of_obj(const std::string& text) {
  const TemporaryFolder folder;
  return view_of(folder.write("room.obj", text).string());
}

TEST(DefaultView, GoesAroundThings) {
  for (const char* scene :
       {"scene:spheres,triangles=2000", "scene:chess,triangles=20000", "scene:thin,triangles=20000"})
    EXPECT_EQ(view_of(scene).surroundings, Surroundings::outside) << scene;
}

TEST(DefaultView, LooksIntoARoomFromItsOpenSide) {
  const DefaultView view = view_of_obj(std::string(kCorners) + kFiveWallsInward);
  EXPECT_EQ(view.surroundings, Surroundings::open);
  for (double fraction : {0.0, 0.5, 1.0}) {
    const Camera camera = camera_on_orbit(view.orbit, fraction);
    EXPECT_GT(camera.eye_world.z, 1);
    EXPECT_LT(std::abs(camera.eye_world.x), camera.eye_world.z);
  }
}

TEST(DefaultView, StandsInAClosedRoomWithALightOfItsOwn) {
  const DefaultView view = view_of_obj(std::string(kCorners) + kFiveWallsInward + kFrontWallInward);
  EXPECT_EQ(view.surroundings, Surroundings::inside);
  const Camera camera = camera_on_orbit(view.orbit, 0.3);
  for (int axis = 0; axis < 3; ++axis) EXPECT_LT(std::abs(camera.eye_world[axis]), 1);
  const DirectionalLight light = default_light(view.surroundings, camera, vec3(0.15f));
  EXPECT_FALSE(light.casts_shadow);
  EXPECT_GT(glm::dot(light.toward, camera.eye_world - camera.target_world), 0) << "from behind the camera";
}

TEST(DefaultView, SharedScenesAreWhatTheyAre) {
  const std::pair<const char*, Surroundings> scenes[] = {
      {"sibenik/sibenik.obj", Surroundings::inside},
      {"holodeck/holodeck.obj", Surroundings::inside},
      {"cornell_box/CornellBox-Mirror.obj", Surroundings::open},
      {"teapot/teapot.obj", Surroundings::outside},
      {"sports_car/sportsCar.obj", Surroundings::outside},
      {"armadillo/armadillo.obj", Surroundings::outside},
      {"scrub_pine/scrubPine.obj", Surroundings::outside}};  // its foliage shows back faces as often as front faces
  for (const auto& [name, surroundings] : scenes) {
    const std::filesystem::path path = std::filesystem::path(HYBRIDRT_SHARED_SCENES) / name;
    if (!std::filesystem::exists(path)) GTEST_SKIP() << "the shared scenes are not here";
    EXPECT_EQ(view_of(path.string()).surroundings, surroundings) << name;
  }
}

TEST(DefaultLight, ComesFromAboveLeftAndBehindTheCamera) {
  const Scene scene = boxed(vec3(-1), vec3(1));
  for (int step = 0; step < 36; ++step) {
    const Camera camera = camera_on_orbit(default_orbit(scene, scene.bounds, 1.5, kPi / 4), step / 36.0);
    const View view = make_view(camera, dvec3(0), 150, 100);
    const dvec3 toward = default_light(Surroundings::outside, camera, vec3(0.15f)).toward;
    EXPECT_NEAR(glm::length(toward), 1, 1e-12);
    EXPECT_GT(toward.y, 0.3) << "above";
    EXPECT_LT(glm::dot(toward, view.right), -0.2) << "left";
    EXPECT_LT(glm::dot(toward, view.forward), -0.2) << "behind";
  }
}

TEST(DefaultLight, CameraLookingStraightDown) {
  const dvec3 toward = default_light(Surroundings::outside, {{0, 5, 0}, {0, 0, 0}, {0, 0, -1}, 1}, vec3(0)).toward;
  EXPECT_NEAR(glm::length(toward), 1, 1e-12);
  EXPECT_GT(toward.y, 0);
}

}  // namespace
}  // namespace hybridrt
