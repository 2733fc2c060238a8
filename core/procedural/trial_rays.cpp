// Trial scenes about reflection and refraction.

#include "core/procedural/trial_parts.h"
#include "core/procedural/trial_scenes.h"

namespace hybridrt {
namespace {

constexpr SceneParameter kField{"field", "of view around the critical angle, degrees", 1e-6, 60, 30};
constexpr SceneParameter kPrism[] = {kField};
constexpr double kPrismIndex = 1.5;

/// Seen straight through its front, its back is met at the critical angle.
Scene make_prism(const SceneValues&) {
  DoubleMesh mesh;
  add_floor(mesh, 6, 24, -2);
  mesh.add_sheet({-6, -1.99, -5}, {12, 0, 0}, {0, 8, 0}, 24, 16, mesh.add(painted("ochre", kOchre)),
                 mesh.add(painted("blue", kBlue)));
  const double slope = std::tan(std::asin(1 / kPrismIndex)), low = -1 - slope, high = -1 + slope;
  mesh.add_hexahedron(
      {{-1, -1, low}, {1, -1, low}, {1, 1, high}, {-1, 1, high}, {-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}},
      mesh.add(glass(kPrismIndex)));
  return scene_of(mesh);
}

SceneShot prism_shot(const SceneValues& values) {
  return trial_shot({0, 0, 3}, {0, 0, 0}, value_of(values, kField), {-0.5, 0.8, 0.35});
}

constexpr SceneParameter kIndexOffset{"index-offset", "index of refraction less 1", -0.5, 2, 0.5};
constexpr SceneParameter kLens[] = {kIndexOffset};

Scene make_lens(const SceneValues& values) {
  DoubleMesh mesh;
  add_floor(mesh, 4, 16);
  mesh.add_sheet({-4, 0.01, -3}, {8, 0, 0}, {0, 5, 0}, 16, 10, mesh.add(painted("ochre", kOchre)),
                 mesh.add(painted("blue", kBlue)));
  mesh.add_ball({0, 1.05, 0}, 1, 64, mesh.add(glass(1 + value_of(values, kIndexOffset))));
  return scene_of(mesh);
}

SceneShot lens_shot(const SceneValues&) { return trial_shot({0.3, 1.4, 4.5}, {0, 1, 0}, 38, {-0.5, 0.8, 0.35}); }

constexpr SceneParameter kReflectivity{"reflectivity", "of the mirrors", 0, 1, 0.85};
constexpr SceneParameter kMirrors[] = {kReflectivity};

Scene make_mirrors(const SceneValues& values) {
  Material mirror;
  mirror.name = "mirror";
  mirror.kd = vec3(0.05f), mirror.ks = vec3(static_cast<float>(value_of(values, kReflectivity))), mirror.ns = 200;
  mirror.illum = 3;
  resolve_material(mirror);
  DoubleMesh mesh;
  add_floor(mesh, 3, 12);
  const uint32_t glossy = mesh.add(mirror);
  mesh.add_sheet({-1, 0.02, 2}, {0, 0, -4}, {0, 2, 0}, 1, glossy);
  mesh.add_sheet({1, 0.02, -2}, {0, 0, 4}, {0, 2, 0}, 1, glossy);
  mesh.add_ball({0.2, 0.42, -0.2}, 0.4, 64, mesh.add(painted("red", kRed)));
  return scene_of(mesh);
}

SceneShot mirrors_shot(const SceneValues&) { return trial_shot({-0.6, 1.1, 1.7}, {0.9, 0.5, 0}, 50, {-0.3, 0.9, 0.4}); }

}  // namespace

ProceduralScene prism_scene() {
  return {"prism", "glass, seen around its critical angle", kPrism, make_prism, prism_shot};
}

ProceduralScene lens_scene() { return {"lens", "a ball of glass before a wall", kLens, make_lens, lens_shot}; }

ProceduralScene mirrors_scene() {
  return {"mirrors", "two mirrors that face each other", kMirrors, make_mirrors, mirrors_shot};
}

}  // namespace hybridrt
