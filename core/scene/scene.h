#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "core/base/math.h"
#include "core/scene/material.h"
#include "core/scene/textures.h"

namespace hybridrt {

struct DirectionalLight {
  dvec3 toward{0, 1, 0};  ///< unit, from the scene toward the light
  vec3 color{1};
  bool casts_shadow = true;
};

/// Light from all around, which casts no shadow and may be stronger from one side: `color` * (1 + dot(slope, normal)),
/// at least 0, arrives at a surface.
struct AmbientLight {
  vec3 color{0.15f};  ///< linear
  vec3 slope{0};      ///< toward where more light comes from

  AmbientLight() = default;
  AmbientLight(const vec3& color_, const vec3& slope_ = vec3(0)) : color(color_), slope(slope_) {}
};

size_t count_shadow_casters(std::span<const DirectionalLight> lights);

/// Indexed triangles, filled once and then only read. Positions are floats relative to `origin_world`
/// (scene space = world space - origin_world), so that a scene far from the world's origin keeps its
/// precision; everything after loading works in scene space.
struct Scene {
  dvec3 origin_world{0};

  std::vector<vec3> positions;               ///< scene space, finite
  std::vector<vec3> normals;                 ///< unit, scene space
  std::vector<uvec3> triangle_positions;     ///< three indices into `positions` per triangle
  std::vector<uvec3> triangle_normals;       ///< three indices into `normals` per triangle
  std::vector<uint32_t> triangle_materials;  ///< index into `materials`
  std::vector<Material> materials;           ///< resolved; at least one

  std::vector<vec3> colors;            ///< linear, 0 to 1: they multiply Kd, interpolated; empty if there are none
  std::vector<uvec3> triangle_colors;  ///< three indices into `colors` per triangle; empty if there are none

  std::shared_ptr<const Textures> textures;  ///< null if no triangle's material has a map

  Aabb bounds;  ///< box of all triangles, scene space

  // Where it came from, for reports.
  std::vector<std::string> files;   ///< all that were read, in order
  std::vector<std::string> notes;   ///< what was made of them where it could be something else, a sentence each
  size_t built_normal_corners = 0;  ///< corners that got their normal from the faces around

  size_t triangle_count() const { return triangle_positions.size(); }
  bool has_colors() const { return !triangle_colors.empty(); }
  bool has_holes() const { return textures && textures->any_holes; }
  bool has_holes(uint32_t triangle) const {
    return has_holes() && textures->has_holes(textures->triangle_maps[triangle]);
  }
  const Material& material_of(uint32_t triangle) const { return materials[triangle_materials[triangle]]; }
  vec3 vertex(uint32_t triangle, int corner) const { return positions[triangle_positions[triangle][corner]]; }
};

/// Bounds of the triangles (unused vertices do not count).
Aabb compute_bounds(const Scene& scene);

/// Throws CheckFailed unless every array has the size stated above, every index is in range, every number finite and
/// every normal unit within 1e-3. Loaders call it last.
void validate(const Scene& scene);

}  // namespace hybridrt
