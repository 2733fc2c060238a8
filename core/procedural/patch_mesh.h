#pragma once

#include <functional>
#include <span>
#include <vector>

#include "core/scene/scene.h"

namespace hybridrt {

/// A smooth piece of a surface, to be cut into a grid of `rows` x `columns` cells of two triangles each.
/// `at(u, v)` for u, v in 0..1 runs along the rows' and columns' direction; d/du x d/dv points outward.
/// A side that is one point (a pole) makes one triangle of each cell there.
struct Patch {
  int rows = 1, columns = 1;
  std::function<dvec3(double u, double v)> at;
  bool point_at_u0 = false, point_at_u1 = false, point_at_v0 = false, point_at_v1 = false;

  int64_t triangles() const {
    return int64_t{2} * rows * columns - int64_t{columns} * (point_at_u0 + point_at_u1) -
           int64_t{rows} * (point_at_v0 + point_at_v1);
  }
};

/// Indexed triangles with a normal for each corner.
struct TriangleMesh {
  std::vector<vec3> positions, normals;
  std::vector<uvec3> triangle_positions, triangle_normals;
};

int64_t count_triangles(std::span<const Patch> patches);

/// The surface that the patches form: where their sides meet (within 2^-21) vertices are shared, but each patch keeps
/// its own normals, so the seam between two is a sharp edge exactly where they meet at an angle. Patches that surround
/// a solid, with as many cells on either side of every seam, give a closed mesh; coordinates should stay below about 8.
TriangleMesh mesh_of(std::span<const Patch> patches);

/// Gives every corner whose normal points behind its triangle the triangle's own.
void use_face_normals_where_others_fail(TriangleMesh& mesh);

/// The place of a copy of a mesh: turned about the up axis (counter-clockwise seen from above), then moved.
struct Placement {
  dvec3 position{0};
  double turn_rad = 0;
};

/// Appends a copy of `mesh` to `scene`.
void add_mesh(Scene& scene, const TriangleMesh& mesh, const Placement& placement, uint32_t material);

}  // namespace hybridrt
