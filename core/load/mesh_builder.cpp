#include "core/load/mesh_builder.h"

#include <algorithm>

#include "core/base/error.h"
#include "core/load/mesh_colors.h"
#include "core/mesh/polygon.h"

namespace hybridrt {
namespace {

/// Appends `value`, unless that and all before it are `none`: then the array stays empty. `count`: those before.
template <typename T>
void append_optional(std::vector<T>& all, size_t count, const T& value, const T& none) {
  if (all.empty() && value == none) return;
  all.resize(count, none);
  all.push_back(value);
}

}  // namespace

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

void MeshBuilder::add_texcoord(const dvec2& texcoord, size_t place) {
  constexpr double kLargest = 1e6;  // as for OBJ
  const bool usable = std::abs(texcoord.x) <= kLargest && std::abs(texcoord.y) <= kLargest;
  if (!usable) bad_texcoords_.add(place);
  data.texcoords.push_back(usable ? vec2(texcoord) : vec2(0));
}

void MeshBuilder::add_face(std::span<const uint32_t> corners, size_t place, const FaceExtras& extras) {
  ++data.faces;
  if (corners.size() < 3) return small_.add(place);
  const auto append = [&](uint32_t a, uint32_t b, uint32_t c) {
    const size_t count = data.triangle_positions.size();
    const uvec3 none(kNoIndex),
        own = extras.texcoords.empty() ? none : uvec3(extras.texcoords[a], extras.texcoords[b], extras.texcoords[c]);
    append_optional(data.triangle_texcoords, count, own, none);
    append_optional(triangle_face_colors_, count, extras.color, kNoIndex);
    data.triangle_positions.emplace_back(corners[a], corners[b], corners[c]);
    data.triangle_materials.push_back(extras.material);
    data.triangle_places.push_back(static_cast<uint32_t>(place));
  };
  if (corners.size() == 3) return append(0, 1, 2);
  const auto is_bad = [&](uint32_t corner) { return !is_usable(data.positions[corner]); };
  if (!bad_vertices_.empty() && std::any_of(corners.begin(), corners.end(), is_bad)) {  // finish() will throw
    for (uint32_t i = 2; i < corners.size(); ++i) append(0, i - 1, i);
    return;
  }
  points_.clear(), cuts_.clear();
  for (uint32_t corner : corners) points_.push_back(data.positions[corner]);
  if (!triangulate_polygon(points_, cuts_)) tangled_.add(place);
  for (const uvec3& cut : cuts_) append(cut.x, cut.y, cut.z);
}

MeshData MeshBuilder::finish(Warnings& warnings) {
  if (const BadVertex* bad = settle_bad_vertices(data, bad_vertices_, warnings))
    throw error(ErrorKind::input, "{}: vertex {}{}: {}, and a face uses it; leave it out or export the mesh again",
                data.path.string(), bad->vertex,
                data.place == std::string_view("line") ? fmt::format(" (line {})", bad->place) : std::string(),
                fault_of_position(data.positions[bad->vertex]));
  report(WarningCode::face_too_small, small_, "faces of fewer than three corners were left out", data.path, warnings,
         data.place);
  report(WarningCode::polygon_tangled, tangled_, "polygons cross themselves or have no area and were cut as they came",
         data.path, warnings, data.place);
  report(WarningCode::texcoord_unusable, bad_texcoords_, "texture coordinates are not usable numbers and were set to 0",
         data.path, warnings, data.place);
  report(WarningCode::color_alpha_unread, alphas_, "colours have an alpha below 1, which is not read", data.path,
         warnings, data.place);
  if (data.triangle_texcoords.empty() && data.texcoords.size() == data.positions.size())
    data.triangle_texcoords = data.triangle_positions;
  add_face_colors(data, std::move(face_colors), triangle_face_colors_, face_color_full, warnings);
  if (!data.normals.empty() && data.normals.size() == data.positions.size())
    data.triangle_normals = data.triangle_positions;
  else
    data.normals.clear();
  return std::move(data);
}

}  // namespace hybridrt
