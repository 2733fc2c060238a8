#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "core/scene/scene.h"
#include "core/scene/scene_shot.h"

namespace hybridrt {

/// Options that every procedural scene takes; absent: the scene's default.
struct ProceduralOptions {
  std::optional<int64_t> triangles;
  std::optional<double> reflective_percent;
};

/// A scene that is made, not read.
struct ProceduralScene {
  std::string_view name, about;
  int64_t fewest_triangles, most_triangles, default_triangles;
  Scene (*make)(const ProceduralOptions&);
  SceneShot (*shot)();
};

std::span<const ProceduralScene> procedural_scenes();

/// Null if there is no scene of that name.
const ProceduralScene* find_procedural(std::string_view name);

/// "chess, spheres, thin", for messages.
std::string procedural_names();

}  // namespace hybridrt
