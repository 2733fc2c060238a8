#pragma once

#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "core/scene/scene.h"
#include "core/scene/scene_shot.h"

namespace hybridrt {

/// A number that a procedural scene takes.
struct SceneParameter {
  std::string_view name, about;
  double least = 0, most = 0;
  std::optional<double> standard;  ///< absent: as the scene is designed
  bool is_count = false;           ///< whole
};

/// Values by their parameters' names. What is absent has the parameter's standard value.
using SceneValues = std::map<std::string, double, std::less<>>;

/// A scene that is made, not read. `make` and `shot` take values that check_value() accepts.
struct ProceduralScene {
  std::string_view name, about;
  std::span<const SceneParameter> parameters;
  Scene (*make)(const SceneValues&);
  SceneShot (*shot)(const SceneValues&);

  /// Null if it takes none of that name.
  const SceneParameter* parameter(std::string_view name) const;
  /// How many triangles it will have, about.
  int64_t triangles(const SceneValues& values) const;
};

std::span<const ProceduralScene> procedural_scenes();

/// Null if there is no scene of that name.
const ProceduralScene* find_procedural(std::string_view name);

/// "chess, spheres, thin", for messages.
std::string procedural_names();

/// Throws Error(usage), saying what is allowed, for a value that the scene's parameter cannot have.
void check_value(const ProceduralScene& scene, const SceneParameter& parameter, double value);

}  // namespace hybridrt
