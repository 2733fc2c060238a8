#pragma once

#include <span>
#include <vector>

#include "core/base/warnings.h"
#include "core/load/bad_vertices.h"
#include "core/load/mesh_data.h"
#include "core/load/text_scan.h"

namespace hybridrt {

/// Fills a MeshData item by item: checks every number and index, cuts polygons into triangles, counts what cannot be
/// used.
class MeshBuilder {
 public:
  /// What a face may have beside its corners.
  struct FaceExtras {
    std::span<const uint32_t> texcoords = {};  ///< of its corners, as indices into data.texcoords
    uint32_t color = kNoIndex;                 ///< index into face_colors
    uint32_t material = 0;                     ///< index into data.material_names
  };

  MeshBuilder(const std::filesystem::path& path, const char* place);

  MeshData data;
  std::vector<vec3> face_colors;  ///< as data.colors
  float face_color_full = 0;      ///< as data.color_full

  /// Coordinates that are not finite or not below 1e30 are faults only if a face uses the vertex: finish() knows.
  void add_vertex(const dvec3& position, size_t place);
  void add_normal(const dvec3& normal) { data.normals.push_back(usable_normal(normal)); }

  /// Corners are indices of vertices; if they are more than three, of vertices that were added. Fewer than three are
  /// counted and left out.
  void add_face(std::span<const uint32_t> corners, size_t place) { add_face(corners, place, {}); }
  void add_face(std::span<const uint32_t> corners, size_t place, const FaceExtras& extras);

  /// The index of this colour in face_colors, for FaceExtras: that of the last one, if it is the same.
  uint32_t add_face_color(const vec3& color) {
    if (face_colors.empty() || face_colors.back() != color) face_colors.push_back(color);
    return static_cast<uint32_t>(face_colors.size() - 1);
  }
  /// Coordinates that are not finite or above a million count as 0, with a warning.
  void add_texcoord(const dvec2& texcoord, size_t place);
  /// Opacity is not read: a warning counts those below `full`.
  void add_alpha(double alpha, double full, size_t place) {
    if (alpha < full) alphas_.add(place);
  }

  /// A corner given as a number. Throws Error (input) unless it is an index below `vertices`.
  uint32_t corner(double index, size_t vertices, size_t place) const;

  /// Warns of what was left out and returns the mesh. If there are as many normals as vertices, they belong to them; so
  /// do texture coordinates of which no face has any. Throws Error (input) naming its place for a vertex that a face
  /// uses and that is no position.
  MeshData finish(Warnings& warnings);

  [[noreturn]] void fail(size_t place, const std::string& problem) const;

 private:
  std::vector<BadVertex> bad_vertices_;
  std::vector<dvec3> points_;
  std::vector<uvec3> cuts_;
  std::vector<uint32_t> triangle_face_colors_;
  Tally small_, tangled_, bad_texcoords_, alphas_;
};

}  // namespace hybridrt
