#pragma once

// Inside core/simplify only: modules of our own for OpenMesh's decimater. It makes them itself, so they get what they
// work on afterwards, before initialize().

#include <OpenMesh/Tools/Decimater/ModQuadricT.hh>
#include <vector>

#include "core/simplify/decimation_mesh.h"

namespace hybridrt::decimation {

/// Keeps what triangles have at their corners: a collapse of v0 into v1 moves corners at v0 to v1, and they become
/// those of the triangles that vanish. Forbids nothing: only kept vertices have edges across which shading changes, at
/// the beginning and after every collapse, so that both of these triangles shade alike at v1.
class KeepCorners final : public Module {
 public:
  using Handle = OpenMesh::Decimater::ModHandleT<KeepCorners>;
  explicit KeepCorners(Mesh& mesh) : Module(mesh, true) {}

  void set(const Scene& scene, const Fans& fans, std::vector<CornerTriangle>& triangle_of_face) {
    scene_ = &scene, fans_ = &fans, triangle_of_face_ = &triangle_of_face;
  }
  void preprocess_collapse(const CollapseInfo& collapse) override;

 private:
  Corner corner_at(Mesh::FaceHandle face, Mesh::VertexHandle vertex) const;

  const Scene* scene_ = nullptr;
  const Fans* fans_ = nullptr;
  std::vector<CornerTriangle>* triangle_of_face_ = nullptr;
};

/// A point of the original surface, and how far the mesh may be from it; mesh space.
struct Sample {
  dvec3 point;
  double bound;
};

/// Keeps the mesh within bounds of samples of the original surface: a collapse is legal where each sample of the
/// triangles around v0 is within its bound of one that remains; the sample then belongs to the nearest of them. So
/// bounds hold for all collapses together.
///
/// The idea is ModHausdorffT's. Why not that one: it has one tolerance; only vertices are samples; a triangle with
/// little area counts as at no distance; and it hands samples to triangles whose vertices the decimater does not look
/// at again, so that a later collapse can exceed the tolerance. Here only triangles around v0 get any.
class SampledBounds final : public Module {
 public:
  using Handle = OpenMesh::Decimater::ModHandleT<SampledBounds>;
  explicit SampledBounds(Mesh& mesh) : Module(mesh, true) {}

  using Quadrics = OpenMesh::Decimater::ModQuadricT<Mesh>;

  /// `samples`: by face, at first; `bound_of_vertex`: by vertex. `quadrics`: the decimater's priorities.
  void set(std::vector<std::vector<Sample>> samples, std::vector<double> bound_of_vertex, Quadrics& quadrics) {
    samples_ = std::move(samples), bound_of_vertex_ = std::move(bound_of_vertex), quadrics_ = &quadrics;
  }
  /// Collapses of a vertex that are no better than one that is legal are not looked at and count as illegal: this is
  /// the dearest test, and the decimater takes the best.
  float collapse_priority(const CollapseInfo& collapse) override;
  void preprocess_collapse(const CollapseInfo& collapse) override;

 private:
  struct Moved {
    Mesh::FaceHandle face;
    dvec3 a, b, c;  ///< after the collapse
  };
  void find_moved(const CollapseInfo& collapse);
  bool keeps_bounds(const CollapseInfo& collapse);

  std::vector<std::vector<Sample>> samples_;  ///< by face
  std::vector<double> bound_of_vertex_;
  Quadrics* quadrics_ = nullptr;
  Mesh::VertexHandle looked_at_;  ///< the vertex whose collapses are looked at
  float best_ = 0;                ///< the priority of the best of them that is legal
  std::vector<Moved> moved_;      ///< of the collapse at hand
  std::vector<Sample> gathered_;  ///< of the collapse at hand
};

}  // namespace hybridrt::decimation
