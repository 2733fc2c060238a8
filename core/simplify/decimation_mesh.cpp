#include "core/simplify/decimation_mesh.h"

#include <algorithm>

#include "core/base/check.h"

namespace hybridrt::decimation {

SurfaceMesh make_surface_mesh(const Scene& scene, const Fans& fans) {
  SurfaceMesh made;
  const dvec3 lo(scene.bounds.lo), hi(scene.bounds.hi), half = (hi - lo) / 2.0;
  made.center = (lo + hi) / 2.0;
  made.mesh_from_scene = 1 / std::max({half.x, half.y, half.z});

  Mesh& mesh = made.mesh;
  const size_t vertices = fans.vertex_of_fan.size();
  mesh.reserve(vertices, 3 * vertices, scene.triangle_count());
  for (size_t fan = 0; fan < vertices; ++fan) {
    const dvec3 p = made.mesh_from_scene * (dvec3(scene.positions[fans.vertex_of_fan[fan]]) - made.center);
    mesh.status(mesh.add_vertex({p.x, p.y, p.z})).set_locked(fans.kept[fan]);
  }
  for (uint32_t t = 0; t < scene.triangle_count(); ++t) {
    if (fans.fan_of_corner[3 * t] == kNoFan) continue;
    const auto vertex = [&](int k) { return Mesh::VertexHandle(static_cast<int>(fans.fan_of_corner[3 * t + k])); };
    HRT_CHECK(mesh.add_face(vertex(0), vertex(1), vertex(2)).is_valid());  // fans are manifold
    made.triangle_of_face.push_back(as_it_is(t));
  }
  mesh.update_face_normals();
  return made;
}

int corner_index_at(const Fans& fans, const CornerTriangle& triangle, uint32_t fan) {
  for (int k = 0; k < 3; ++k)
    if (fans.fan_of_corner[triangle.corners[k]] == fan) return k;
  throw CheckFailed("a face has no corner at one of its vertices");
}

}  // namespace hybridrt::decimation
