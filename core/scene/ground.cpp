#include "core/scene/ground.h"

#include <algorithm>
#include <memory>

namespace hybridrt {
namespace {

constexpr float kSizes = 30;     // half its width, in sizes of what stands on it
constexpr float kBelow = 1e-4f;  // likewise
constexpr float kGrey = 0.5f;

/// Gives the new triangle no texture. The textures are shared and read-only, so they are copied.
void extend_textures(Scene& scene) {
  auto extended = std::make_shared<Textures>(*scene.textures);
  extended->triangle_texcoords.resize(scene.triangle_count(), uvec3(0));
  extended->triangle_maps.resize(scene.triangle_count(), 0);
  if (extended->texcoords.empty()) extended->texcoords.push_back(vec2(0));
  scene.textures = std::move(extended);
}

void extend_colors(Scene& scene) {
  const auto white = static_cast<uint32_t>(scene.colors.size());
  scene.colors.push_back(vec3(1));
  scene.triangle_colors.resize(scene.triangle_count(), uvec3(white));
}

}  // namespace

void add_ground(Scene& scene, const Aabb& framed) {
  const float size = std::max(glm::length(framed.extent()), 1e-30f), half = kSizes * size;
  const vec3 middle = framed.center();
  const float y = framed.lo.y - kBelow * size;
  const auto first = static_cast<uint32_t>(scene.positions.size());
  for (const vec2 corner : {vec2(-1, -1), vec2(-1, 1), vec2(1, 1), vec2(1, -1)})
    scene.positions.push_back({middle.x + half * corner.x, y, middle.z + half * corner.y});
  const auto up = static_cast<uint32_t>(scene.normals.size());
  scene.normals.push_back({0, 1, 0});
  Material matte;
  matte.name = "ground";
  matte.kd = vec3(kGrey);
  const auto material = static_cast<uint32_t>(scene.materials.size());
  scene.materials.push_back(matte);
  for (const uvec3 corners : {uvec3(0, 1, 2), uvec3(0, 2, 3)}) {
    scene.triangle_positions.push_back(first + corners);
    scene.triangle_normals.push_back(uvec3(up));
    scene.triangle_materials.push_back(material);
  }
  if (scene.has_colors()) extend_colors(scene);
  if (scene.textures) extend_textures(scene);
  scene.bounds = compute_bounds(scene);
}

}  // namespace hybridrt
