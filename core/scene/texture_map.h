#pragma once

#include <cstddef>
#include <filesystem>

#include "core/base/math.h"

namespace hybridrt {

/// What a texture changes: map_Kd, map_Ks, map_Ke, map_d. The order is that of HRT_MAP_* (shaders/shared.h).
enum class MapKind { diffuse, specular, emitted, holes };

/// A texture as an MTL statement names it. Its value at texture coordinates (u, v) is base + gain * the image at
/// (u, v) * scale + offset.
struct TextureMap {
  MapKind kind = MapKind::diffuse;
  std::filesystem::path path;  ///< empty: there is no such file
  vec2 scale{1}, offset{0};    ///< -s, -o
  bool clamped = false;        ///< -clamp on: the edge goes on outside the image; else the image repeats
  float base = 0, gain = 1;    ///< -mm
  bool alone = false;          ///< the colour that it multiplies was not given: it counts as 1
  char channel = 0;            ///< -imfchan: r, g, b, m (alpha), l (luminance), z; 0: not given
};

}  // namespace hybridrt
