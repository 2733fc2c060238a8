#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "core/base/math.h"

namespace hybridrt {

inline constexpr uint32_t kNoIndex = 0xFFFFFFFFu;

/// Coordinates are smaller: their squares still fit a double, they themselves a float.
inline constexpr double kLargestCoordinate = 1e30;

/// A mesh file as written, cut into triangles, nothing repaired yet.
struct MeshData {
  std::filesystem::path path;                              ///< for messages
  const char* place = "line";                              ///< what `triangle_places` counts: "line" or "face"
  std::vector<dvec3> positions;                            ///< world space, finite, each |coordinate| < 1e30
  std::vector<vec3> normals;                               ///< unit, or zero where the file's cannot be used
  std::vector<vec2> texcoords;                             ///< finite, each at most a million; of an OBJ
  std::vector<uvec3> triangle_positions;                   ///< in range; corners may repeat
  std::vector<uvec3> triangle_normals;                     ///< kNoIndex where there is none; empty: none anywhere
  std::vector<uvec3> triangle_texcoords;                   ///< likewise
  std::vector<uint32_t> triangle_materials;                ///< index into `material_names`
  std::vector<uint32_t> triangle_places;                   ///< for messages
  std::vector<std::string> material_names{std::string()};  ///< the first: before any material is named
  std::vector<std::string> libraries;                      ///< of an OBJ: the rest of each `mtllib` line
  size_t faces = 0;                                        ///< of the file, the unusable ones too
};

/// `n` made unit as scenes want it, bit by bit the same where it is unit to float precision already; zero
/// where it has no usable direction.
vec3 usable_normal(const dvec3& n);

}  // namespace hybridrt
