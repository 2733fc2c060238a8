#include "core/procedural/procedural.h"

#include <cmath>

#include "core/base/error.h"
#include "core/procedural/chess.h"
#include "core/procedural/spheres.h"
#include "core/procedural/thin.h"
#include "core/procedural/trial_scenes.h"

namespace hybridrt {
namespace {

constexpr double kSmallScene = 100'000;  // triangles of scenes that do not say

template <typename Options>
constexpr SceneParameter triangles() {
  return {"triangles",
          "total number, met within 5 %",
          Options::kFewestTriangles,
          Options::kMostTriangles,
          static_cast<double>(Options().triangles),
          true};
}

constexpr SceneParameter reflective(std::optional<double> standard) {
  return {"reflective", "percent of components that are mirrors, the rest matt", 0, 100, standard, false};
}

constexpr SceneParameter kChess[] = {triangles<ChessOptions>(), reflective({})};
constexpr SceneParameter kSpheres[] = {triangles<SpheresOptions>(), reflective(SpheresOptions().reflective_percent)};
constexpr SceneParameter kThin[] = {triangles<ThinOptions>(), reflective({})};

template <typename Options, Scene (*make)(const Options&)>
Scene make_with(const SceneValues& values) {
  Options options;
  if (const auto given = values.find("triangles"); given != values.end())
    options.triangles = static_cast<int64_t>(given->second);
  if (const auto given = values.find("reflective"); given != values.end()) options.reflective_percent = given->second;
  return make(options);
}

template <SceneShot (*shot)()>
SceneShot shot_of(const SceneValues&) {
  return shot();
}

}  // namespace

const SceneParameter* ProceduralScene::parameter(std::string_view parameter_name) const {
  for (const SceneParameter& parameter : parameters)
    if (parameter.name == parameter_name) return &parameter;
  return nullptr;
}

int64_t ProceduralScene::triangles(const SceneValues& values) const {
  const SceneParameter* count = parameter("triangles");
  const auto given = values.find("triangles");
  return static_cast<int64_t>(given != values.end() ? given->second : count ? *count->standard : kSmallScene);
}

std::span<const ProceduralScene> procedural_scenes() {
  static const ProceduralScene kScenes[] = {
      {"chess", "a game of chess in wood, glass and metal", kChess, make_with<ChessOptions, make_chess>,
       shot_of<chess_shot>},
      {"spheres", "a field of balls", kSpheres, make_with<SpheresOptions, make_spheres>, shot_of<spheres_shot>},
      {"thin", "grass, wires, a fence and a grating", kThin, make_with<ThinOptions, make_thin>, shot_of<thin_shot>},
      stage_scene(),
      wires_scene(),
      slivers_scene(),
      sheets_scene(),
      prism_scene(),
      lens_scene(),
      mirrors_scene(),
      eye_scene(),
  };
  return kScenes;
}

const ProceduralScene* find_procedural(std::string_view name) {
  for (const ProceduralScene& scene : procedural_scenes())
    if (scene.name == name) return &scene;
  return nullptr;
}

std::string procedural_names() {
  std::string names;
  for (const ProceduralScene& scene : procedural_scenes()) names.append(names.empty() ? "" : ", ").append(scene.name);
  return names;
}

void check_value(const ProceduralScene& scene, const SceneParameter& parameter, double value) {
  if (parameter.is_count && value != std::floor(value))
    throw error(ErrorKind::usage, "{}: {} needs a whole number, not {:.15g}", scene.name, parameter.name, value);
  if (!(value >= parameter.least && value <= parameter.most))
    throw error(ErrorKind::usage, "{}: {} must be {:.15g} to {:.15g}, not {:.15g}", scene.name, parameter.name,
                parameter.least, parameter.most, value);
}

}  // namespace hybridrt
