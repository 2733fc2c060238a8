#include "core/load/mesh_builder.h"

#include <algorithm>

#include "core/base/error.h"
#include "core/mesh/polygon.h"

namespace hybridrt {

MeshBuilder::MeshBuilder(const std::filesystem::path& path, const char* place) {
  data.path = path;
  data.place = place;
}

void MeshBuilder::fail(size_t place, const std::string& problem) const {
  if (data.place == std::string_view("line"))
    throw error(ErrorKind::input, "{}:{}: {}", data.path.string(), place, problem);
  throw error(ErrorKind::input, "{}: {} {}: {}", data.path.string(), data.place, place, problem);
}

void MeshBuilder::add_vertex(const dvec3& position, size_t place) {
  if (!is_usable(position)) bad_vertices_.push_back({data.positions.size(), place});
  data.positions.push_back(position);
}

uint32_t MeshBuilder::corner(double index, size_t vertices, size_t place) const {
  if (!(index >= 0 && index < static_cast<double>(vertices) && index == std::floor(index)))
    fail(place, fmt::format("{:.17g} is not the index of a vertex; there are {}, counted from 0", index, vertices));
  return static_cast<uint32_t>(index);
}

void MeshBuilder::add_face(std::span<const uint32_t> corners, size_t place) {
  ++data.faces;
  if (corners.size() < 3) return small_.add(place);
  const auto append = [&](uint32_t a, uint32_t b, uint32_t c) {
    data.triangle_positions.emplace_back(a, b, c);
    data.triangle_materials.push_back(0);
    data.triangle_places.push_back(static_cast<uint32_t>(place));
  };
  if (corners.size() == 3) return append(corners[0], corners[1], corners[2]);
  const auto is_bad = [&](uint32_t corner) { return !is_usable(data.positions[corner]); };
  if (!bad_vertices_.empty() && std::any_of(corners.begin(), corners.end(), is_bad)) {  // finish() will throw
    for (size_t i = 2; i < corners.size(); ++i) append(corners[0], corners[i - 1], corners[i]);
    return;
  }
  points_.clear(), cuts_.clear();
  for (uint32_t corner : corners) points_.push_back(data.positions[corner]);
  if (!triangulate_polygon(points_, cuts_)) tangled_.add(place);
  for (const uvec3& cut : cuts_) append(corners[cut.x], corners[cut.y], corners[cut.z]);
}

MeshData MeshBuilder::finish(Warnings& warnings) {
  if (const BadVertex* bad = settle_bad_vertices(data, bad_vertices_, warnings))
    throw error(ErrorKind::input, "{}: vertex {}{}: {}, and a face uses it; leave it out or export the mesh again",
                data.path.string(), bad->vertex,
                data.place == std::string_view("line") ? fmt::format(" (line {})", bad->place) : std::string(),
                fault_of_position(data.positions[bad->vertex]));
  report(small_, "faces of fewer than three corners were left out", data.path, warnings, data.place);
  report(tangled_, "polygons cross themselves or have no area and were cut as they came", data.path, warnings,
         data.place);
  if (!data.normals.empty() && data.normals.size() == data.positions.size())
    data.triangle_normals = data.triangle_positions;
  else
    data.normals.clear();
  return std::move(data);
}

}  // namespace hybridrt
