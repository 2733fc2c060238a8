#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "core/base/math.h"
#include "core/scene/material.h"

namespace hybridrt {

inline constexpr uint32_t kNoIndex = 0xFFFFFFFFu;

/// Coordinates are smaller than this: they fit a float, their squares a double.
inline constexpr double kLargestCoordinate = 1e30;

/// A mesh file as written: cut into triangles, but not repaired.
struct MeshData {
  std::filesystem::path path;             ///< for messages
  const char* place = "line";             ///< what `triangle_places` counts: "line" or "face"
  std::vector<dvec3> positions;           ///< world space, finite, each |coordinate| < 1e30
  std::vector<vec3> normals;              ///< unit, or zero where the file's cannot be used
  std::vector<vec2> texcoords;            ///< finite, each at most a million; OBJ only
  std::vector<uvec3> triangle_positions;  ///< in range; corners may repeat
  std::vector<uvec3> triangle_normals;    ///< kNoIndex where there is none; empty: none anywhere
  std::vector<uvec3> triangle_texcoords;  ///< likewise
  std::vector<vec3> colors;               ///< the file's numbers, or kNoColor (mesh_colors.h); empty: none anywhere
  std::vector<uvec3> triangle_colors;     ///< kNoIndex where there is none; empty: `colors` are those of `positions`
  float color_full = 0;  ///< the number that means full brightness; 0: 1 or 255, as the numbers suggest
  std::vector<uint32_t> triangle_materials;                ///< index into `material_names`
  std::vector<uint32_t> triangle_places;                   ///< for messages
  std::vector<std::string> material_names{std::string()};  ///< the first: until a material is named
  std::vector<std::string> libraries;                      ///< OBJ only: the rest of each `mtllib` line
  std::vector<Material> materials;                         ///< PLY only: those of its textures
  size_t faces = 0;                                        ///< faces of the file, unusable ones included
};

/// `n` as a unit vector. Unchanged to the bit where it is unit to float precision already; zero where it has no usable
/// direction.
vec3 usable_normal(const dvec3& n);

}  // namespace hybridrt
