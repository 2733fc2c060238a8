#include "core/load/bad_vertices.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace hybridrt {
namespace {

bool is_usable(double coordinate) { return std::abs(coordinate) < kLargestCoordinate; }

}  // namespace

bool is_usable(const dvec3& position) {
  return is_usable(position.x) && is_usable(position.y) && is_usable(position.z);
}

std::string fault_of_position(const dvec3& position) {
  int axis = 0;
  while (axis < 2 && is_usable(position[axis])) ++axis;
  const double value = position[axis];
  return fmt::format("its {} coordinate is {}", "xyz"[axis],
                     std::isnan(value)   ? "NaN"
                     : std::isinf(value) ? "infinite"
                                         : "not below 1e30");
}

const BadVertex* settle_bad_vertices(MeshData& mesh, std::span<const BadVertex> bad, Warnings& warnings) {
  if (bad.empty()) return nullptr;
  size_t used = mesh.positions.size();
  for (const uvec3& triangle : mesh.triangle_positions)
    for (int corner = 0; corner < 3; ++corner)
      if (!is_usable(mesh.positions[triangle[corner]])) used = std::min<size_t>(used, triangle[corner]);
  if (used < mesh.positions.size())
    return &*std::find_if(bad.begin(), bad.end(), [&](const BadVertex& b) { return b.vertex == used; });

  const dvec3 other = mesh.triangle_positions.empty() ? dvec3(0) : mesh.positions[mesh.triangle_positions[0].x];
  Tally left_out;
  for (const BadVertex& vertex : bad) {
    mesh.positions[vertex.vertex] = other;
    left_out.add(vertex.place);
  }
  const char* place = mesh.place == std::string_view("line") ? "line" : "vertex";
  report(WarningCode::vertex_unusable, left_out,
         "vertices are NaN, infinite or not below 1e30 and were left out, as no face uses them", mesh.path, warnings,
         place);
  return nullptr;
}

}  // namespace hybridrt
