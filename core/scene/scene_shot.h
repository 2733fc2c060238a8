#pragma once

#include <optional>
#include <vector>

#include "core/scene/camera.h"
#include "core/scene/scene.h"

namespace hybridrt {

/// How to look at a procedural scene. What is absent is left to the defaults of any scene (an orbit around it, a light
/// over the camera's left shoulder).
struct SceneShot {
  std::optional<Camera> camera;
  std::optional<std::vector<DirectionalLight>> lights;
  std::optional<vec3> ambient, background;
};

}  // namespace hybridrt
