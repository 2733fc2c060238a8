#include "core/simplify/corners.h"

#include <span>

#include "core/base/check.h"

namespace hybridrt {
namespace {

constexpr uint32_t kUnused = 0xFFFFFFFFu;

/// The elements that the triangles use of `elements`, through `indices` (three a triangle), in their order.
template <typename Element>
void take_used(const std::vector<Element>& elements, const std::vector<uvec3>& indices,
               const std::vector<CornerTriangle>& triangles, std::vector<Element>& used_elements,
               std::vector<uvec3>& used_indices) {
  used_elements.clear();
  used_indices.clear();
  if (indices.empty()) return;
  const auto index_at = [&](Corner corner) { return indices[corner / 3][static_cast<int>(corner % 3)]; };
  std::vector<uint32_t> place(elements.size(), kUnused);
  for (const CornerTriangle& triangle : triangles)
    for (Corner corner : triangle.corners) place[index_at(corner)] = 0;
  for (size_t i = 0; i < elements.size(); ++i) {
    if (place[i] == kUnused) continue;
    place[i] = static_cast<uint32_t>(used_elements.size());
    used_elements.push_back(elements[i]);
  }
  used_indices.reserve(triangles.size());
  for (const CornerTriangle& triangle : triangles) {
    const auto& [a, b, c] = triangle.corners;
    used_indices.emplace_back(place[index_at(a)], place[index_at(b)], place[index_at(c)]);
  }
}

std::vector<uint32_t> of_origins(std::span<const uint32_t> values, const std::vector<CornerTriangle>& triangles) {
  std::vector<uint32_t> taken;
  taken.reserve(triangles.size());
  for (const CornerTriangle& triangle : triangles) taken.push_back(values[triangle.from]);
  return taken;
}

}  // namespace

bool shade_alike(const Scene& scene, Corner a, Corner b) {
  const uint32_t t = a / 3, u = b / 3;
  const int j = static_cast<int>(a % 3), k = static_cast<int>(b % 3);
  if (scene.triangle_materials[t] != scene.triangle_materials[u]) return false;
  if (scene.normals[scene.triangle_normals[t][j]] != scene.normals[scene.triangle_normals[u][k]]) return false;
  if (scene.has_colors() && scene.colors[scene.triangle_colors[t][j]] != scene.colors[scene.triangle_colors[u][k]])
    return false;
  if (!scene.textures) return true;
  const Textures& textures = *scene.textures;
  return textures.triangle_maps[t] == textures.triangle_maps[u] &&
         textures.texcoords[textures.triangle_texcoords[t][j]] == textures.texcoords[textures.triangle_texcoords[u][k]];
}

Scene scene_of_corners(const Scene& scene, const std::vector<CornerTriangle>& triangles) {
  Scene made;
  made.origin_world = scene.origin_world;
  take_used(scene.positions, scene.triangle_positions, triangles, made.positions, made.triangle_positions);
  take_used(scene.normals, scene.triangle_normals, triangles, made.normals, made.triangle_normals);
  take_used(scene.colors, scene.triangle_colors, triangles, made.colors, made.triangle_colors);
  made.triangle_materials = of_origins(scene.triangle_materials, triangles);
  made.materials = scene.materials;
  if (scene.textures) {
    Textures textures;
    textures.words = scene.textures->words;
    take_used(scene.textures->texcoords, scene.textures->triangle_texcoords, triangles, textures.texcoords,
              textures.triangle_texcoords);
    textures.triangle_maps = of_origins(scene.textures->triangle_maps, triangles);
    for (uint32_t maps : textures.triangle_maps) textures.any_holes = textures.any_holes || textures.has_holes(maps);
    made.textures = std::make_shared<const Textures>(std::move(textures));
  }
  made.files = scene.files;
  made.notes = scene.notes;
  made.bounds = compute_bounds(made);
  validate(made);
  return made;
}

}  // namespace hybridrt
