#include "core/load/scene_source.h"

#include <gtest/gtest.h>

#include "core/procedural/chess.h"
#include "core/procedural/spheres.h"
#include "core/procedural/thin.h"
#include "tests/support/load_scene.h"
#include "tests/support/obj_test.h"

namespace hybridrt {
namespace {

TEST(SceneSource, TakesProceduralScenesAndFiles) {
  ThreadPool pool(2);
  Warnings warnings;
  const Scene made = load_scene("scene:spheres,triangles=3000,reflective=50", pool, warnings);
  EXPECT_EQ(made.positions, make_spheres({3000, 50}).positions);
  EXPECT_EQ(load_scene("scene:spheres", pool, warnings).triangle_count(), 500'000u);
  const TemporaryFolder folder;
  EXPECT_EQ(load_scene(folder.write("A.OBJ", kTriangle + "f 1 2 3\n").string(), pool, warnings).triangle_count(), 1u);
}

TEST(SceneSource, SaysWhatIsAllowed) {
  const TemporaryFolder folder;
  const std::string blend = folder.write("a.blend", "x").string();
  const std::tuple<std::string, ErrorKind, std::string> cases[] = {
      {"scene:cubes", ErrorKind::usage, "spheres"},
      {"scene:", ErrorKind::usage, "spheres"},
      {"scene:spheres,colour=3", ErrorKind::usage, "triangles, reflective"},
      {"scene:spheres,triangles=many", ErrorKind::usage, "'many'"},
      {"scene:spheres,triangles=1000.5", ErrorKind::usage, "whole number"},
      {"scene:spheres,triangles", ErrorKind::usage, "triangles needs a number"},
      {"scene:spheres,triangles=5", ErrorKind::usage, "100 to 20000000"},
      {"scene:spheres,reflective=nan", ErrorKind::usage, "reflective"},
      {"scene:spheres,reflective=101", ErrorKind::usage, "0 to 100"},
      {"/nowhere/to/be/found.obj", ErrorKind::input, "does not exist"},
      {blend, ErrorKind::input, ".blend files are not read"},
      {folder.path.string(), ErrorKind::input, "is a directory"},
  };
  ThreadPool pool(1);
  Warnings warnings;
  for (const auto& [argument, kind, part] : cases) {
    try {
      load_scene(argument, pool, warnings);
      ADD_FAILURE() << argument;
    } catch (const Error& error) {
      EXPECT_EQ(error.kind(), kind) << argument;
      EXPECT_TRUE(contains(error.what(), part)) << error.what();
    }
  }
}

TEST(SceneSource, KnowsChessAndThin) {
  ThreadPool pool(1);
  Warnings warnings;
  EXPECT_EQ(load_scene("scene:chess,triangles=12000,reflective=5", pool, warnings).positions,
            make_chess({12'000, 5}).positions);
  EXPECT_EQ(load_scene("scene:thin,triangles=12000", pool, warnings).positions, make_thin({12'000, {}}).positions);
}

TEST(SceneSource, TellsHowAProceduralSceneWantsToBeSeen) {
  for (const ProceduralScene& scene : procedural_scenes()) {
    const SceneSource source = parse_scene_source("scene:" + std::string(scene.name));
    EXPECT_EQ(source.procedural, &scene);
    EXPECT_TRUE(source.procedural_values.empty());
    const SceneShot shot = scene.shot({});
    EXPECT_EQ(source.shot.has_value(), shot.camera.has_value());
    if (shot.camera) {
      const Camera first = camera_on_orbit(std::get<Orbit>(*source.shot), 0);
      EXPECT_LT(glm::distance(first.eye_world, shot.camera->eye_world), 1e-9);
    }
    EXPECT_EQ(source.lights.has_value(), shot.lights.has_value());
    EXPECT_EQ(source.ambient, shot.ambient);
  }
}

}  // namespace
}  // namespace hybridrt
