#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/base/math.h"
#include "core/scene/texture_map.h"

namespace hybridrt {

/// The textures of a scene and where they lie on its triangles. Filled while loading, then only read and shared:
/// structures that ask it for holes may outlive the scene.
struct Textures {
  std::vector<uint32_t> words;            ///< all textures, laid out as in shaders/shared.h
  std::vector<vec2> texcoords;            ///< v grows upward in the image
  std::vector<uvec3> triangle_texcoords;  ///< three indices into `texcoords` a triangle
  std::vector<uint32_t> triangle_maps;    ///< Material::texture_maps of each triangle
  bool any_holes = false;                 ///< in any triangle

  /// `maps`: as in triangle_maps.
  bool has_holes(uint32_t maps) const { return maps != 0 && words[maps + static_cast<uint32_t>(MapKind::holes)] != 0; }
  size_t memory_bytes() const {
    return words.size() * 4 + texcoords.size() * sizeof(vec2) + triangle_texcoords.size() * sizeof(uvec3) +
           triangle_maps.size() * 4;
  }
};

/// Most words of all textures: a GPU texture of 16384 by 16384.
inline constexpr uint64_t kMostTextureWords = uint64_t{1} << 28;
/// Largest side of one texture.
inline constexpr int kLargestTextureSide_px = 16384;
inline constexpr uint64_t kMostTexels = uint64_t{1} << 27;

}  // namespace hybridrt
