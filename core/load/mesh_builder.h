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
  MeshBuilder(const std::filesystem::path& path, const char* place);

  MeshData data;

  /// Coordinates that are not finite or not below 1e30 are faults only if a face uses the vertex: finish() knows.
  void add_vertex(const dvec3& position, size_t place);
  void add_normal(const dvec3& normal) { data.normals.push_back(usable_normal(normal)); }

  /// Corners are indices of vertices; if they are more than three, of vertices that were added. Fewer than three are
  /// counted and left out.
  void add_face(std::span<const uint32_t> corners, size_t place);

  /// A corner given as a number. Throws Error (input) unless it is an index below `vertices`.
  uint32_t corner(double index, size_t vertices, size_t place) const;

  /// Warns of what was left out and returns the mesh. If there are as many normals as vertices, they belong to them.
  /// Throws Error (input) naming its place for a vertex that a face uses and that is no position.
  MeshData finish(Warnings& warnings);

  [[noreturn]] void fail(size_t place, const std::string& problem) const;

 private:
  std::vector<BadVertex> bad_vertices_;
  std::vector<dvec3> points_;
  std::vector<uvec3> cuts_;
  Tally small_, tangled_;
};

}  // namespace hybridrt
