#include "core/load/off_io.h"

#include <algorithm>
#include <fmt/format.h>
#include <limits>

#include "core/base/warnings.h"
#include "core/load/mesh_builder.h"
#include "core/load/mesh_colors.h"
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
void read_extras(OffLines& lines, const OffHeader& header, OffExtras& extras) {
  for (size_t i = 0; i < extras.per_vertex; ++i) {
    const bool is_needed = header.one_line || (header.normals && i < 3);
    extras.numbers.push_back(is_needed ? lines.coordinate()
                                       : parse_number(lines.word()).value_or(std::numeric_limits<double>::quiet_NaN()));
  }
}

/// Gives each vertex so far room for more numbers.
void widen(OffExtras& extras, size_t vertices, size_t per_vertex) {
  std::vector<double> wider(vertices * per_vertex, std::numeric_limits<double>::quiet_NaN());
  for (size_t i = 0; i < vertices; ++i)
    std::copy_n(extras.numbers.begin() + static_cast<ptrdiff_t>(i * extras.per_vertex), extras.per_vertex,
                wider.begin() + static_cast<ptrdiff_t>(i * per_vertex));
  extras = {per_vertex, std::move(wider)};
}

OffExtras read_vertices(OffLines& lines, const OffHeader& header, MeshBuilder& mesh) {
  OffExtras extras;
  for (size_t i = 0; i < header.vertices; ++i) {
    if (!header.one_line && !(i == 0 && header.at_vertex)) lines.next("the last vertex");
    const dvec3 position = read_position(lines, header);
    mesh.add_vertex(position, lines.place());
    if (i == 0)
      extras.per_vertex =
          (header.normals ? 3 : 0) + (header.one_line ? (header.colors ? 4 : 0) + (header.texture ? 2 : 0) : 0);
    if (const size_t there = header.one_line ? 0 : std::min(lines.words_left(), kMostExtras); there > extras.per_vertex)
      widen(extras, i, there);  // the first line nearly always has them all
    read_extras(lines, header, extras);
  }
  return extras;
}

/// Gives the vertices their normals and colours.
void add_extras(const OffColumns& columns, const OffExtras& extras, MeshBuilder& mesh, Warnings& warnings) {
  const bool has_colors = columns.color_count == 3 || columns.color_count == 4;
  const std::string file = mesh.data.path.filename().string();
  if (columns.color_count > 0 && !has_colors)
    warnings.emplace_back(
        WarningCode::color_ignored,
        fmt::format("{}: its vertices have colours of {} numbers, not three or four; they were left out", file,
                    columns.color_count));
  if (!columns.has_normals && !has_colors) return;
  size_t see_through = 0;
  for (size_t at = 0; at < extras.numbers.size(); at += extras.per_vertex) {
    const double* const row = &extras.numbers[at];
    const double *const n = row + columns.normal, *const c = row + columns.color;
    if (columns.has_normals) mesh.add_normal({n[0], n[1], n[2]});
    if (has_colors) mesh.data.colors.push_back(color_of_numbers({c[0], c[1], c[2]}));
    if (columns.color_count == 4) see_through += c[3] < 1;
  }
  if (see_through > 0)
    warnings.emplace_back(
        WarningCode::color_alpha_unread,
        fmt::format("{}: {} vertices have a colour with an alpha below 1, which is not read", file, see_through));
}

/// The colour that ends the line of a face: three numbers, or four with alpha. Others, of colour maps, are counted.
vec3 read_face_color(OffLines& lines, MeshBuilder& mesh, Tally& unread_colors) {
  const size_t count = lines.words_left();
  if (count == 0) return kNoColor;
  dvec3 numbers(std::numeric_limits<double>::quiet_NaN());
  for (int i = 0; i < 3 && count >= 3; ++i)
    numbers[i] = parse_number(lines.word()).value_or(std::numeric_limits<double>::quiet_NaN());
  if (count > 3) mesh.add_alpha(parse_number(lines.word()).value_or(1), 1, lines.place());
  const vec3 color = color_of_numbers(numbers);
  if (color == kNoColor) unread_colors.add(lines.place());
  return color;
}

void read_faces(OffLines& lines, const OffHeader& header, MeshBuilder& mesh, Tally& unread_colors) {
  std::vector<uint32_t> corners;
  for (size_t i = 0; i < header.faces; ++i) {
    if (!header.one_line) lines.next("the last face");
    const size_t count = lines.count(kMostCorners);
    corners.clear();
    while (corners.size() < count) corners.push_back(mesh.corner(lines.number(), header.vertices, lines.place()));
    MeshBuilder::FaceExtras extras;
    const vec3 color = header.one_line ? kNoColor : read_face_color(lines, mesh, unread_colors);
    if (color != kNoColor) extras.color = mesh.add_face_color(color);
    mesh.add_face(corners, lines.place(), extras);
  }
}

}  // namespace

MeshData read_off(const std::filesystem::path& path, Warnings& warnings) {
  MeshBuilder mesh(path, "line");
  OffLines lines(path, mesh);
  const OffHeader header = read_off_header(lines, mesh, static_cast<double>(std::filesystem::file_size(path)));
  const OffExtras extras = read_vertices(lines, header, mesh);
  add_extras(find_columns(header, extras), extras, mesh, warnings);
  Tally unread_colors;
  read_faces(lines, header, mesh, unread_colors);
  report(WarningCode::color_unusable, unread_colors,
         "faces have colours that are not three or four numbers, and were left out", path, warnings);
  if (header.texture)
    warnings.emplace_back(WarningCode::texcoord_unread,
                          path.filename().string() + ": texture coordinates were left out: OFF names no texture");
  return mesh.finish(warnings);
}

}  // namespace hybridrt
