#include "core/scene/scene.h"

#include <algorithm>

#include "core/base/check.h"

namespace hybridrt {

size_t count_shadow_casters(std::span<const DirectionalLight> lights) {
  return static_cast<size_t>(
      std::count_if(lights.begin(), lights.end(), [](const DirectionalLight& light) { return light.casts_shadow; }));
}

Aabb compute_bounds(const Scene& scene) {
  Aabb bounds;
  for (const uvec3& triangle : scene.triangle_positions)
    for (int corner = 0; corner < 3; ++corner) bounds.grow(scene.positions[triangle[corner]]);
  return bounds;
}

void validate(const Scene& scene) {
  HRT_CHECK_EQ(scene.triangle_normals.size(), scene.triangle_count());
  HRT_CHECK_EQ(scene.triangle_materials.size(), scene.triangle_count());
  HRT_CHECK(!scene.materials.empty());
  for (const vec3& p : scene.positions) HRT_CHECK(all_finite(p));
  for (const vec3& n : scene.normals) HRT_CHECK(std::abs(glm::dot(n, n) - 1) < 2e-3f);
  for (size_t i = 0; i < scene.triangle_count(); ++i) {
    for (int corner = 0; corner < 3; ++corner) {
      HRT_CHECK(scene.triangle_positions[i][corner] < scene.positions.size());
      HRT_CHECK(scene.triangle_normals[i][corner] < scene.normals.size());
    }
    HRT_CHECK(scene.triangle_materials[i] < scene.materials.size());
  }
  HRT_CHECK_EQ(scene.has_colors(), !scene.colors.empty());
  if (scene.has_colors()) HRT_CHECK_EQ(scene.triangle_colors.size(), scene.triangle_count());
  for (const vec3& color : scene.colors)
    for (int i = 0; i < 3; ++i) HRT_CHECK(color[i] >= 0 && color[i] <= 1);
  for (const uvec3& corners : scene.triangle_colors)
    for (int corner = 0; corner < 3; ++corner) HRT_CHECK(corners[corner] < scene.colors.size());
  if (!scene.textures) return;
  const Textures& textures = *scene.textures;
  HRT_CHECK_EQ(textures.triangle_texcoords.size(), scene.triangle_count());
  HRT_CHECK_EQ(textures.triangle_maps.size(), scene.triangle_count());
  for (size_t i = 0; i < scene.triangle_count(); ++i) {
    HRT_CHECK_EQ(textures.triangle_maps[i], scene.materials[scene.triangle_materials[i]].texture_maps);
    for (int corner = 0; corner < 3; ++corner)
      HRT_CHECK(textures.triangle_texcoords[i][corner] < textures.texcoords.size());
  }
}

}  // namespace hybridrt
