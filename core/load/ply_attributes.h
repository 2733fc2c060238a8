#pragma once

#include <array>

#include "core/load/ply_header.h"

namespace hybridrt {

/// Where an element has a colour: red, green and blue, r, g and b, or diffuse_red and so on.
struct PlyColor {
  std::array<int, 3> channels{-1, -1, -1};  ///< indices of properties
  int alpha = -1;
  float full = 0;  ///< as MeshData::color_full
  double full_alpha = 1;

  bool any() const { return channels[0] >= 0 || channels[1] >= 0 || channels[2] >= 0; }
  bool complete() const { return channels[0] >= 0 && channels[1] >= 0 && channels[2] >= 0; }
};
PlyColor find_color(const PlyElement& element);

/// The properties that are the texture coordinates of a vertex, or -1: s t, u v, texture_u texture_v, texture_s
/// texture_t.
std::array<int, 2> find_texcoord(const PlyElement& element);

}  // namespace hybridrt
