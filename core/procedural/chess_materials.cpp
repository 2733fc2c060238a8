#include "core/procedural/chess_materials.h"

#include <algorithm>

#include "core/base/check.h"
#include "core/procedural/paint.h"

namespace hybridrt {
namespace {

/// `kd` is also the colour of the matt stand-in, where the material itself has none.
struct Recipe {
  const char* name;
  vec3 kd, ks;
  float ns;
  int illum;
  vec3 tf{1};
};

// Linear.
const Recipe kRecipes[] = {
    {"ivory", {0.62f, 0.50f, 0.33f}, vec3(0.22f), 70, 2},
    {"ebony", {0.020f, 0.016f, 0.014f}, vec3(0.08f), 160, 5},
    {"crystal", {0.62f, 0.70f, 0.66f}, vec3(0.45f), 350, 4, {0.93f, 0.98f, 0.96f}},
    {"ruby_glass", {0.35f, 0.03f, 0.03f}, vec3(0.45f), 350, 4, {0.86f, 0.20f, 0.18f}},
    {"gold", {0.26f, 0.15f, 0.035f}, {0.80f, 0.58f, 0.26f}, 220, 3},
    {"gunmetal", {0.02f, 0.022f, 0.028f}, {0.46f, 0.48f, 0.53f}, 220, 3},
    {"maple", {0.47f, 0.30f, 0.14f}, vec3(0.13f), 120, 3},
    {"maple_pale", {0.51f, 0.34f, 0.17f}, vec3(0.13f), 120, 3},
    {"maple_warm", {0.44f, 0.27f, 0.115f}, vec3(0.13f), 120, 3},
    {"walnut", {0.105f, 0.038f, 0.016f}, vec3(0.13f), 120, 3},
    {"walnut_dark", {0.085f, 0.030f, 0.013f}, vec3(0.13f), 120, 3},
    {"walnut_red", {0.125f, 0.041f, 0.016f}, vec3(0.13f), 120, 3},
    {"frame", {0.050f, 0.018f, 0.009f}, vec3(0.13f), 120, 3},
    {"stringing", {0.50f, 0.34f, 0.16f}, vec3(0.13f), 120, 3},
    {"table", {0.045f, 0.040f, 0.036f}, vec3(0.08f), 60, 3},
};

Material cook(const Recipe& recipe, bool plain, bool mirror) {
  if (plain) return painted(recipe.name, recipe.kd, mirror);
  Material m;
  m.name = recipe.name;
  m.kd = recipe.kd, m.ks = recipe.ks, m.ns = recipe.ns, m.illum = recipe.illum, m.tf = recipe.tf;
  if (m.illum == 4) m.kd = vec3(0), m.ni = 1.5f;
  resolve_material(m);
  return m;
}

}  // namespace

uint32_t ChessMaterials::find(std::string_view name, bool mirror) {
  const auto recipe =
      std::find_if(std::begin(kRecipes), std::end(kRecipes), [&](const Recipe& r) { return r.name == name; });
  HRT_CHECK(recipe != std::end(kRecipes));
  Material made = cook(*recipe, plain_, mirror);
  std::vector<Material>& all = scene_.materials;
  const auto found = std::find_if(all.begin(), all.end(), [&](const Material& m) { return m.name == made.name; });
  const auto index = static_cast<uint32_t>(found - all.begin());
  if (found == all.end()) all.push_back(std::move(made));
  return index;
}

uint32_t ChessMaterials::of_piece(bool white, ChessFinish finish, bool mirror) {
  if (plain_ || finish == ChessFinish::plain) return find(white ? "ivory" : "ebony", mirror);
  if (finish == ChessFinish::glass) return find(white ? "crystal" : "ruby_glass", mirror);
  return find(white ? "gold" : "gunmetal", mirror);
}

}  // namespace hybridrt
