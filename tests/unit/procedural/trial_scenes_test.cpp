#include "core/procedural/trial_scenes.h"

#include <gtest/gtest.h>

#include "core/procedural/double_mesh.h"
#include "tests/support/closed_mesh.h"

namespace hybridrt {
namespace {

std::vector<ProceduralScene> trial_scenes() {
  return {stage_scene(), wires_scene(), slivers_scene(), sheets_scene(),
          prism_scene(), lens_scene(),  mirrors_scene(), eye_scene()};
}

TEST(DoubleMesh, BallsAndBoxesAreClosedAndFaceOutward) {
  for (const int segments : {4, 5, 7, 64}) {
    DoubleMesh mesh;
    const uint32_t material = mesh.add(Material());
    mesh.add_ball({1, 2, 3}, 0.5, segments, material);
    mesh.add_box({-2, -2, -2}, {-1, -0.5, 0}, material);
    const Scene scene = scene_of(mesh);
    expect_closed(scene);
    expect_outward(scene);
  }
}

TEST(DoubleMesh, KeepsFarDetailsAndLeavesOutWhatHasNoArea) {
  DoubleMesh mesh;
  const uint32_t material = mesh.add(Material());
  mesh.add_sheet({0, 0, 0}, {1, 0, 0}, {0, 0, -1}, 2, material);
  const Scene near_by = scene_of(mesh);
  mesh.place(1, {3e7, 0, -1e8});
  const Scene far_away = scene_of(mesh);
  ASSERT_EQ(far_away.triangle_count(), near_by.triangle_count());
  for (size_t i = 0; i < near_by.positions.size(); ++i)
    EXPECT_EQ(dvec3(far_away.positions[i]) + far_away.origin_world, dvec3(near_by.positions[i]) + dvec3(3e7, 0, -1e8));

  DoubleMesh narrow;
  narrow.add(Material());
  narrow.add_sheet({1, 0, 0}, {1, 0, 0}, {0, 0, -1}, 2, 0);
  narrow.add_sheet({1, 1, 0}, {1e-9, 0, 0}, {0, 0, -1}, 1, 0);  // no width, so far from the origin
  EXPECT_EQ(scene_of(narrow).triangle_count(), near_by.triangle_count());
}

TEST(TrialScenes, AreMadeAtTheEndsOfAllTheirRanges) {
  for (const ProceduralScene& scene : trial_scenes()) {
    const size_t triangles = scene.make({}).triangle_count();
    EXPECT_GT(triangles, 10u) << scene.name;
    EXPECT_LT(triangles, 20'000u) << scene.name;
    for (const SceneParameter& parameter : scene.parameters)
      for (const double value : {parameter.least, parameter.most}) {
        SCOPED_TRACE(testing::Message() << scene.name << "," << parameter.name << "=" << value);
        const SceneValues values = {{std::string(parameter.name), value}};
        EXPECT_GT(scene.make(values).triangle_count(), 0u);
        const SceneShot shot = scene.shot(values);
        ASSERT_TRUE(shot.camera && shot.lights && shot.lights->size() == 1);
        EXPECT_NEAR(glm::length(shot.lights->front().toward), 1, 1e-12);
        EXPECT_TRUE(std::isfinite(glm::length(shot.camera->eye_world)));
      }
  }
}

TEST(TrialScenes, EveryParameterChangesSceneOrShot) {
  for (const ProceduralScene& scene : trial_scenes())
    for (const SceneParameter& parameter : scene.parameters) {
      const double other = parameter.most == parameter.standard.value_or(-1) ? parameter.least : parameter.most;
      const SceneValues values = {{std::string(parameter.name), other}};
      const Scene usual = scene.make({}), made = scene.make(values);
      const SceneShot usual_shot = scene.shot({}), shot = scene.shot(values);
      const bool material_differs =
          usual.materials.back().ni != made.materials.back().ni || usual.materials[2].ks != made.materials[2].ks;
      EXPECT_TRUE(usual.positions != made.positions || material_differs ||
                  usual_shot.camera->eye_world != shot.camera->eye_world ||
                  usual_shot.camera->fov_y_rad != shot.camera->fov_y_rad ||
                  usual_shot.lights->front().toward != shot.lights->front().toward)
          << scene.name << " " << parameter.name;
    }
}

TEST(TrialScenes, WiresAreAsThickAsAsked) {
  for (const double thickness : {0.1, 1e-3, 1e-6}) {
    const Scene scene = wires_scene().make({{"thickness", thickness}});
    float lowest = 1, highest = 0;  // of the wires along x, which lie below the others
    for (const vec3& p : scene.positions)
      if (p.y > 0.3f && p.y < 0.62f) lowest = std::min(lowest, p.y), highest = std::max(highest, p.y);
    EXPECT_NEAR(highest - lowest, thickness, 1e-7);
  }
}

}  // namespace
}  // namespace hybridrt
