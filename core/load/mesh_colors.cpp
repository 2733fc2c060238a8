#include "core/load/mesh_colors.h"

#include <algorithm>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <span>

#include "core/image/srgb.h"

namespace hybridrt {
namespace {

constexpr float kLargestOfOne = 1.5f;  // 0 to 1, with some room for rounding and light; beyond, 0 to 255 is meant
constexpr uint32_t kWhite = 0;         // the first of scene.colors

float largest_number(const std::vector<vec3>& colors) {
  float largest = 0;
  for (const vec3& color : colors) largest = std::max({largest, color.x, color.y, color.z});
  return largest;
}

/// The number that means full brightness.
float full_brightness(const std::vector<vec3>& colors, float full) {
  if (full > 0) return full;
  return largest_number(colors) > kLargestOfOne ? 255.f : 1.f;
}

bool all_are(const std::vector<vec3>& colors, bool white, float full) {
  return std::all_of(colors.begin(), colors.end(), [&](const vec3& color) {
    const auto is = [&](float x) { return white ? x >= 0.9999f * full : x <= 0; };
    return color == kNoColor || (is(color.x) && is(color.y) && is(color.z));
  });
}

void make_linear(std::vector<vec3>& colors, float full, bool are_linear) {
  for (vec3& color : colors)
    for (int i = 0; i < 3; ++i) {
      const float share = color == kNoColor ? 1.f : std::clamp(color[i] / full, 0.f, 1.f);
      color[i] = are_linear ? share : static_cast<float>(linear_from_srgb(share));
    }
}

bool has_diffuse_map(const Material& material) {
  return std::any_of(material.maps.begin(), material.maps.end(),
                     [](const TextureMap& map) { return map.kind == MapKind::diffuse; });
}

/// How many triangles their colours paint, tint, and do nothing to.
struct Uses {
  size_t alone = 0, with_kd = 0, with_map = 0;
};

std::string text_of(const Uses& uses) {
  std::vector<std::string> done;
  if (uses.alone > 0) done.push_back(fmt::format("are the diffuse colour of {} triangles", uses.alone));
  if (uses.with_kd > 0) done.push_back(fmt::format("multiply Kd of {} triangles", uses.with_kd));
  if (uses.with_map > 0) done.push_back(fmt::format("were left out on {} triangles with a map_Kd", uses.with_map));
  return fmt::format("{}", fmt::join(done, ", "));
}

/// 1 + the index of the material of triangles that have none but a colour.
uint32_t colored_material_in(Scene& scene, uint32_t known) {
  if (known != 0) return known;
  Material& made = scene.materials.emplace_back();
  made.name = "colours", made.kd = vec3(1);
  resolve_material(made);
  return static_cast<uint32_t>(scene.materials.size());
}

constexpr double kLargestColor = 1e9;  // beyond, a number that nobody means as a colour

}  // namespace

vec3 color_of_numbers(const dvec3& numbers) {
  if (glm::any(glm::isnan(numbers))) return kNoColor;
  return vec3(glm::clamp(numbers, 0.0, kLargestColor));
}

void add_face_colors(MeshData& mesh, std::vector<vec3>&& of_faces, const std::vector<uint32_t>& triangles, float full,
                     Warnings& warnings) {
  if (of_faces.empty() || triangles.empty()) return;
  if (!mesh.colors.empty() && !has_plain_colors(mesh.colors, mesh.color_full)) {
    if (!has_plain_colors(of_faces, full))
      warnings.emplace_back(
          WarningCode::color_ignored,
          mesh.path.filename().string() + ": the colours of its faces were left out, since its vertices have colours");
    return;
  }
  mesh.colors = std::move(of_faces);
  mesh.color_full = full;
  mesh.triangle_colors.clear();
  mesh.triangle_colors.reserve(triangles.size());
  for (const uint32_t color : triangles) mesh.triangle_colors.emplace_back(color);
}

bool has_plain_colors(const std::vector<vec3>& colors, float full) {
  full = full_brightness(colors, full);
  return all_are(colors, false, full) || all_are(colors, true, full);
}

void take_colors(MeshData& mesh, size_t first_triangle, uint32_t first_vertex, bool linear, Scene& scene,
                 uint32_t& colored_material, Warnings& warnings) {
  if (mesh.colors.empty()) return;
  const bool of_vertices = mesh.triangle_colors.empty();
  const auto text = [&](const std::string& what) {
    return fmt::format("{}: the colours of its {} {}", mesh.path.filename().string(),
                       of_vertices ? "vertices" : "faces", what);
  };
  const auto note = [&](const std::string& what) { scene.notes.push_back(text(what)); };
  const auto warn = [&](const std::string& what) { warnings.emplace_back(WarningCode::color_ignored, text(what)); };
  const float full = full_brightness(mesh.colors, mesh.color_full);
  if (all_are(mesh.colors, false, full)) return warn("are all black and were left out");
  if (all_are(mesh.colors, true, full)) return note("are all white and change nothing");

  const size_t before = scene.colors.size();
  if (scene.colors.empty()) scene.colors.push_back(vec3(1));
  const auto first_color = static_cast<uint32_t>(scene.colors.size());
  scene.triangle_colors.resize(first_triangle, uvec3(kWhite));
  scene.triangle_colors.reserve(scene.triangle_count());
  std::vector<bool> mapped;
  for (const Material& material : scene.materials) mapped.push_back(has_diffuse_map(material));
  Uses uses;
  for (size_t i = first_triangle; i < scene.triangle_count(); ++i) {
    const uvec3 colors =
        of_vertices ? scene.triangle_positions[i] - first_vertex : mesh.triangle_colors[i - first_triangle];
    uvec3& corners = scene.triangle_colors.emplace_back(kWhite);
    uint32_t& material = scene.triangle_materials[i];
    const bool has_map = material != 0 && material <= mapped.size() && mapped[material - 1];
    bool colored = false;
    for (int corner = 0; corner < 3; ++corner) {
      const uint32_t color = colors[corner];
      if (color == kNoIndex || mesh.colors[color] == kNoColor) continue;
      colored = true;
      if (!has_map) corners[corner] = first_color + color;
    }
    if (!colored) continue;
    ++(has_map ? uses.with_map : material == 0 ? uses.alone : uses.with_kd);
    if (material == 0) material = colored_material = colored_material_in(scene, colored_material);
  }

  if (uses.alone + uses.with_kd == 0) {
    scene.triangle_colors.resize(before == 0 ? 0 : scene.triangle_count());
    scene.colors.resize(before);
    return warn("were left out: its triangles have a map_Kd");
  }
  make_linear(mesh.colors, full, linear);
  scene.colors.insert(scene.colors.end(), mesh.colors.begin(), mesh.colors.end());
  const std::string what = fmt::format("({}, 0 to {:g}) {}", linear ? "linear" : "sRGB", full, text_of(uses));
  uses.with_map > 0 ? warn(what) : note(what);
}

}  // namespace hybridrt
