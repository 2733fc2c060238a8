// Trial scenes about light and shadow.

#include "core/procedural/trial_parts.h"
#include "core/procedural/trial_scenes.h"

namespace hybridrt {
namespace {

constexpr SceneParameter kElevation{"elevation", "of the light over the horizon, degrees", 0, 90, 45},
    kFromView{"from-view", "from the eye to the light, degrees; replaces elevation", 0, 180, {}},
    kEyeElevation{"eye-elevation", "of the eye over the plane, degrees", 0, 90, 25},
    kSegments{"segments", "of the ball, around", 4, 1024, 64, true}, kScale{"scale", "of everything", 1e-12, 1e12, 1},
    kDistance{"distance", "of everything from the origin", 0, 1e12, 0},
    kSpread{"spread", "distance from the origin, with something as far beyond it", 0, 1e8, 0};
constexpr SceneParameter kStage[] = {kElevation, kFromView, kEyeElevation, kSegments, kScale, kDistance, kSpread};

dvec3 offset_of(const SceneValues& values) {
  return (value_of(values, kDistance) + value_of(values, kSpread)) * dvec3(0.64, 0.48, 0.6);
}

Scene make_stage(const SceneValues& values) {
  DoubleMesh mesh;
  add_floor(mesh, 3, 6);
  mesh.add_ball({-0.9, 0.72, 0}, 0.7, static_cast<int>(value_of(values, kSegments)), mesh.add(painted("red", kRed)));
  mesh.add_box({0.5, 0.02, -0.6}, {1.5, 1.1, 0.4}, mesh.add(painted("blue", kBlue)));
  mesh.place(value_of(values, kScale), offset_of(values));
  if (const double spread = value_of(values, kSpread); spread > 0)
    mesh.add_sheet(-offset_of(values), {1, 0, 0}, {0, 0, -1}, 1, mesh.add(painted("far", kPale)));
  return scene_of(mesh);
}

SceneShot stage_shot(const SceneValues& values) {
  const double scale = value_of(values, kScale), up_rad = value_of(values, kEyeElevation) * kPi / 180;
  const dvec3 toward_eye(0, std::sin(up_rad), std::cos(up_rad));
  const double light_rad = value_of(values, kElevation) * kPi / 180;
  dvec3 toward_light = std::cos(light_rad) * dvec3(-0.6, 0, 0.8) + dvec3(0, std::sin(light_rad), 0);
  if (is_given(values, kFromView)) {
    const double from_rad = value_of(values, kFromView) * kPi / 180;
    const dvec3 aside = glm::normalize(dvec3(-1, 0, 0) + glm::cross(toward_eye, dvec3(1, 0, 0)));
    toward_light = std::cos(from_rad) * toward_eye + std::sin(from_rad) * aside;
  }
  const dvec3 offset = offset_of(values);
  return trial_shot(offset + scale * 6 * toward_eye, offset, 40, toward_light);
}

constexpr SceneParameter kThickness{"thickness", "of the wires", 1e-9, 0.2, 0.02};
constexpr SceneParameter kWires[] = {kThickness};

Scene make_wires(const SceneValues& values) {
  DoubleMesh mesh;
  add_floor(mesh, 2, 4);
  const uint32_t steel = mesh.add(painted("steel", kDark));
  const double half = value_of(values, kThickness) / 2;
  for (int i = -4; i <= 4; ++i) {
    const double at = 0.4 * i;
    mesh.add_box({-1.9, 0.5 - half, at - half}, {1.9, 0.5 + half, at + half}, steel);
    mesh.add_box({at - half, 0.75 - half, -1.9}, {at + half, 0.75 + half, 1.9}, steel);
  }
  return scene_of(mesh);
}

SceneShot wires_shot(const SceneValues&) { return trial_shot({0.2, 3.2, 4}, {0, 0.2, 0}, 38, {-0.5, 0.8, 0.35}); }

}  // namespace

ProceduralScene stage_scene() {
  return {"stage", "a ball and a box on a plane, near and far, small and large", kStage, make_stage, stage_shot};
}

ProceduralScene wires_scene() { return {"wires", "a mesh of wires over a plane", kWires, make_wires, wires_shot}; }

}  // namespace hybridrt
