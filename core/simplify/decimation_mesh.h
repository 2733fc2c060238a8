#pragma once

// Inside core/simplify only: OpenMesh's types stay in its .cpp files.

#include <OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh>
#include <OpenMesh/Tools/Decimater/ModBaseT.hh>
#include <vector>

#include "core/simplify/kept_vertices.h"

namespace hybridrt::decimation {

struct MeshTraits : OpenMesh::DefaultTraits {
  using Point = OpenMesh::Vec3d;
  using Normal = OpenMesh::Vec3d;
  VertexAttributes(OpenMesh::Attributes::Status);
  EdgeAttributes(OpenMesh::Attributes::Status);
  HalfedgeAttributes(OpenMesh::Attributes::Status | OpenMesh::Attributes::PrevHalfedge);
  FaceAttributes(OpenMesh::Attributes::Status | OpenMesh::Attributes::Normal);
};
using Mesh = OpenMesh::TriMesh_ArrayKernelT<MeshTraits>;
using CollapseInfo = OpenMesh::Decimater::CollapseInfoT<Mesh>;
using Module = OpenMesh::Decimater::ModBaseT<Mesh>;

inline dvec3 to_dvec3(const Mesh::Point& p) { return {p[0], p[1], p[2]}; }

/// The fans of a scene as vertices of a half-edge mesh, in mesh space: the scene's box fits into [-1, 1], so that no
/// threshold inside OpenMesh meets numbers of an unexpected size. Vertex i is fan i; kept ones are locked.
struct SurfaceMesh {
  Mesh mesh;
  std::vector<CornerTriangle> triangle_of_face;
  dvec3 center{0};             ///< scene space
  double mesh_from_scene = 1;  ///< scale
};
SurfaceMesh make_surface_mesh(const Scene& scene, const Fans& fans);

/// Which of the three corners of a face lies at a fan.
int corner_index_at(const Fans& fans, const CornerTriangle& triangle, uint32_t fan);

}  // namespace hybridrt::decimation
