#pragma once

#include <vector>

#include "core/scene/scene.h"

namespace hybridrt {

/// A mesh under construction, in double precision, so that its parts may be as small and as far away as one likes.
/// Parts are appended; each has vertices of its own. Triangles wind counter-clockwise as seen from outside.
struct DoubleMesh {
  std::vector<dvec3> positions;
  std::vector<vec3> normals;
  std::vector<uvec3> triangle_positions, triangle_normals;
  std::vector<uint32_t> triangle_materials;
  std::vector<Material> materials;

  uint32_t add(const Material& material);

  /// From `corner` along `u` and `v`, in cells of two triangles; u x v points outward. Cells take turns with the two
  /// materials, as a chess board's.
  void add_sheet(const dvec3& corner, const dvec3& u, const dvec3& v, int cells_u, int cells_v, uint32_t material,
                 uint32_t other_material);
  void add_sheet(const dvec3& corner, const dvec3& u, const dvec3& v, int cells, uint32_t material) {
    add_sheet(corner, u, v, cells, cells, material, material);
  }
  /// A hexahedron: its side z = 0 is corners 0 to 3, counter-clockwise as seen from +z, which is inside; corners 4 to 7
  /// lie opposite them. Closed.
  void add_hexahedron(const dvec3 (&corners)[8], uint32_t material);
  void add_box(const dvec3& lo, const dvec3& hi, uint32_t material);
  /// Closed, with smooth normals: `segments` around, half as many from pole to pole.
  void add_ball(const dvec3& center, double radius, int segments, uint32_t material);

  /// Scales, then moves.
  void place(double scale, const dvec3& offset);
};

/// In single precision, relative to its origin. Triangles that have no area there are left out. Throws
/// Error(usage) if none is left.
Scene scene_of(const DoubleMesh& mesh);

}  // namespace hybridrt
