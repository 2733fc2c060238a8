#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "core/base/math.h"
#include "core/base/warnings.h"

namespace hybridrt {

inline constexpr uint32_t kNoIndex = 0xFFFFFFFFu;

/// An OBJ file as written, cut into triangles, nothing repaired yet.
struct ObjData {
  std::vector<dvec3> positions;              ///< world space, finite, each |coordinate| < 1e30
  std::vector<vec3> normals;                 ///< unit, or zero where the file's cannot be used
  std::vector<uvec3> triangle_positions;     ///< in range; corners may repeat
  std::vector<uvec3> triangle_normals;       ///< kNoIndex where there is none; empty: none anywhere
  std::vector<uint32_t> triangle_materials;  ///< index into `material_names`
  std::vector<uint32_t> triangle_lines;      ///< for messages
  std::vector<std::string> material_names;   ///< as `usemtl` says them; the first is "": before any usemtl
  std::vector<std::string> libraries;        ///< the rest of each `mtllib` line
  size_t faces = 0;                          ///< `f` lines, the unusable ones too
};

/// Reads through tinyobjloader, behind ObjFilter. Throws Error (input) naming file and line; warnings say
/// what was left out.
ObjData parse_obj(const std::filesystem::path& path, Warnings& warnings);

}  // namespace hybridrt
