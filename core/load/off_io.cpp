#include "core/load/off_io.h"

#include <limits>

#include "core/base/warnings.h"
#include "core/load/mesh_builder.h"
#include "core/load/off_columns.h"
#include "core/load/off_header.h"

namespace hybridrt {
namespace {

constexpr double kMostCorners = 1 << 20;   // per polygon
constexpr size_t kMostExtras = 3 + 4 + 2;  // normal, colour with alpha, texture coordinate

dvec3 read_position(OffLines& lines, const OffHeader& header) {
  const double x = lines.coordinate(), y = lines.coordinate(), z = lines.coordinate();
  return header.homogeneous ? dvec3(x, y, z) / lines.coordinate() : dvec3(x, y, z);
}

/// Reads what follows the position of a vertex; what is no number, or not there, is NaN.
void read_extras(OffLines& lines, const OffHeader& header, OffExtras& extras, Tally& colors) {
  const size_t normal_count = header.normals ? 3 : 0, texture_count = header.texture ? 2 : 0;
  if (header.colors || (!header.one_line && lines.words_left() > normal_count + texture_count))
    colors.add(lines.place());
  for (size_t i = 0; i < extras.per_vertex; ++i) {
    const bool is_needed = header.one_line || (header.normals && i < normal_count);
    extras.numbers.push_back(is_needed ? lines.coordinate()
                                       : parse_number(lines.word()).value_or(std::numeric_limits<double>::quiet_NaN()));
  }
}

OffExtras read_vertices(OffLines& lines, const OffHeader& header, MeshBuilder& mesh, Tally& colors) {
  OffExtras extras;
  for (size_t i = 0; i < header.vertices; ++i) {
    if (!header.one_line && !(i == 0 && header.at_vertex)) lines.next("the last vertex");
    const dvec3 position = read_position(lines, header);
    mesh.add_vertex(position, lines.place());
    if (i == 0 && header.one_line)
      extras.per_vertex = (header.normals ? 3 : 0) + (header.colors ? 4 : 0) + (header.texture ? 2 : 0);
    else if (i == 0)
      extras.per_vertex = std::max<size_t>(std::min(lines.words_left(), kMostExtras), header.normals ? 3 : 0);
    read_extras(lines, header, extras, colors);
  }
  return extras;
}

void read_faces(OffLines& lines, const OffHeader& header, MeshBuilder& mesh, Tally& colors) {
  std::vector<uint32_t> corners;
  for (size_t i = 0; i < header.faces; ++i) {
    if (!header.one_line) lines.next("the last face");
    const size_t count = lines.count(kMostCorners);
    corners.clear();
    while (corners.size() < count) corners.push_back(mesh.corner(lines.number(), header.vertices, lines.place()));
    mesh.add_face(corners, lines.place());
    if (!header.one_line && !lines.done()) colors.add(lines.place());
  }
}

}  // namespace

MeshData read_off(const std::filesystem::path& path, Warnings& warnings) {
  MeshBuilder mesh(path, "line");
  OffLines lines(path, mesh);
  const OffHeader header = read_off_header(lines, mesh, static_cast<double>(std::filesystem::file_size(path)));
  Tally colors;
  const OffExtras extras = read_vertices(lines, header, mesh, colors);
  const OffColumns columns = find_columns(header, extras);
  if (columns.has_normals)
    for (size_t at = columns.normal; at < extras.numbers.size(); at += extras.per_vertex)
      mesh.add_normal({extras.numbers[at], extras.numbers[at + 1], extras.numbers[at + 2]});
  read_faces(lines, header, mesh, colors);
  report(colors, "vertices and faces have colours, which are ignored", path, warnings);
  return mesh.finish(warnings);
}

}  // namespace hybridrt
