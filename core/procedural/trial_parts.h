#pragma once

#include "core/procedural/double_mesh.h"
#include "core/procedural/paint.h"
#include "core/procedural/procedural.h"

namespace hybridrt {

// What the trial scenes share.

inline double value_of(const SceneValues& values, const SceneParameter& parameter) {
  const auto given = values.find(parameter.name);
  return given != values.end() ? given->second : parameter.standard.value_or(0);
}

inline bool is_given(const SceneValues& values, const SceneParameter& parameter) {
  return values.contains(parameter.name);
}

/// Colours of low and high contrast to the light grey of the plane; linear.
inline constexpr vec3 kPale{0.55f, 0.53f, 0.50f}, kDark{0.20f, 0.22f, 0.26f}, kRed{0.55f, 0.16f, 0.10f},
    kBlue{0.13f, 0.27f, 0.45f}, kOchre{0.62f, 0.38f, 0.10f};

/// A square of two tones around (0, y, 0), `half` to each side.
inline void add_floor(DoubleMesh& mesh, double half, int cells, double y = 0) {
  mesh.add_sheet({-half, y, half}, {2 * half, 0, 0}, {0, 0, -2 * half}, cells, cells, mesh.add(painted("pale", kPale)),
                 mesh.add(painted("tile", 0.8f * kPale)));
}

/// Clear glass: all that is not reflected goes through.
inline Material glass(double index) {
  Material m;
  m.name = "glass";
  m.kd = vec3(0), m.ks = vec3(0), m.ni = static_cast<float>(index), m.illum = 7, m.opacity = 0;
  resolve_material(m);
  return m;
}

/// One camera and one white light; the sky is light, so that rays that go astray are seen.
inline SceneShot trial_shot(const dvec3& eye, const dvec3& target, double fov_y_deg, const dvec3& toward_light) {
  SceneShot shot;
  Camera camera;
  camera.eye_world = eye, camera.target_world = target, camera.fov_y_rad = fov_y_deg * kPi / 180;
  shot.camera = camera;
  shot.lights = {DirectionalLight{glm::normalize(toward_light), vec3(1)}};
  shot.background = vec3(0.50f, 0.62f, 0.80f);
  shot.ambient = vec3(0.15f);
  return shot;
}

}  // namespace hybridrt
