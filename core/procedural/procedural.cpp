#include "core/procedural/procedural.h"

#include "core/procedural/chess.h"
#include "core/procedural/spheres.h"
#include "core/procedural/thin.h"

namespace hybridrt {
namespace {

template <typename Options>
Options filled(const ProceduralOptions& options) {
  Options filled;
  if (options.triangles) filled.triangles = *options.triangles;
  if (options.reflective_percent) filled.reflective_percent = *options.reflective_percent;
  return filled;
}

template <typename Options, Scene (*make)(const Options&)>
Scene make_with(const ProceduralOptions& options) {
  return make(filled<Options>(options));
}

template <typename Options, Scene (*make)(const Options&)>
constexpr ProceduralScene entry(std::string_view name, std::string_view about, SceneShot (*shot)()) {
  return {
      name, about, Options::kFewestTriangles, Options::kMostTriangles, Options().triangles, make_with<Options, make>,
      shot};
}

constexpr ProceduralScene kScenes[] = {
    entry<ChessOptions, make_chess>("chess", "a game of chess in wood, glass and metal", chess_shot),
    entry<SpheresOptions, make_spheres>("spheres", "a field of balls", spheres_shot),
    entry<ThinOptions, make_thin>("thin", "grass, wires, a fence and a grating", thin_shot),
};

}  // namespace

std::span<const ProceduralScene> procedural_scenes() { return kScenes; }

const ProceduralScene* find_procedural(std::string_view name) {
  for (const ProceduralScene& scene : kScenes)
    if (scene.name == name) return &scene;
  return nullptr;
}

std::string procedural_names() {
  std::string names;
  for (const ProceduralScene& scene : kScenes) names.append(names.empty() ? "" : ", ").append(scene.name);
  return names;
}

}  // namespace hybridrt
