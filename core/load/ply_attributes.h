#pragma once

#include <array>

#include "core/base/warnings.h"
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

/// Whether a face has texture coordinates of its corners, a list "texcoord".
bool has_corner_texcoords(const PlyElement& element);

/// Which numbers of a vertex are read.
struct PlyVertexLayout {
  /// The places of a vertex's numbers in a row of them.
  enum Number { kX, kNormal = 3, kRed = 6, kAlpha = 9, kU = 10, kNumbers = 12 };
  std::vector<int> slots;  ///< a Number for each property; -1: not read
  bool has_normals = false, has_color = false, has_alpha = false, has_texcoord = false;
  PlyColor color;
};

/// Throws Error (input) if there is no position. Warns of an incomplete colour. `textured`: texture coordinates are
/// read.
PlyVertexLayout vertex_layout(const PlyElement& element, bool textured, const std::filesystem::path& path,
                              Warnings& warnings);

}  // namespace hybridrt
