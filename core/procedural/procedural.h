#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "core/scene/scene.h"
#include "core/scene/scene_shot.h"

namespace hybridrt {

/// What every procedural scene can be told; absent: the scene's own default.
struct ProceduralOptions {
  std::optional<int64_t> triangles;
  std::optional<double> reflective_percent;
};

/// One of the scenes that are made, not read.
struct ProceduralScene {
  std::string_view name, about;
  int64_t fewest_triangles, most_triangles, default_triangles;
  Scene (*make)(const ProceduralOptions&);
  SceneShot (*shot)();
};

std::span<const ProceduralScene> procedural_scenes();

/// Null when there is none of that name.
const ProceduralScene* find_procedural(std::string_view name);

/// "chess, spheres, thin", for messages.
std::string procedural_names();

}  // namespace hybridrt
