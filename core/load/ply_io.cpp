#include "core/load/ply_io.h"

#include <algorithm>

#include "core/base/error.h"
#include "core/load/mesh_builder.h"
#include "core/load/ply_values.h"

namespace hybridrt {
namespace {

constexpr double kMostListed = 1 << 20;  // corners of one polygon, numbers of any other list

bool is_color(std::string_view property) { return property == "red" || property == "r" || property == "diffuse_red"; }

/// Reads the length of the next list.
template <typename Values>
size_t list_length(Values& values, const PlyProperty& property, const MeshBuilder& mesh, uint64_t index) {
  const double count = values.next(property.count_type);
  if (!(count >= 0 && count <= kMostListed && count == std::floor(count)))
    mesh.fail(values.place(index), fmt::format("a list of {:g} numbers; there must be 0 to {}", count, kMostListed));
  values.require(static_cast<uint64_t>(count), property.type);
  return static_cast<size_t>(count);
}

template <typename Values>
void skip(Values& values, const PlyProperty& property, const MeshBuilder& mesh, uint64_t index) {
  const size_t count = property.is_list ? list_length(values, property, mesh, index) : 1;
  for (size_t i = 0; i < count; ++i) values.next(property.type);
}

template <typename Values>
void read_vertices(Values& values, const PlyElement& element, MeshBuilder& mesh, Warnings& warnings) {
  // What each property is: 0-2 position, 3-5 normal, else skipped.
  constexpr const char* kNames[6] = {"x", "y", "z", "nx", "ny", "nz"};
  std::vector<int> slots(element.properties.size(), -1);
  int known = 0;
  for (int i = 0; i < 6; ++i)
    if (const int at = element.find(kNames[i]); at >= 0 && !element.properties[static_cast<size_t>(at)].is_list)
      slots[static_cast<size_t>(at)] = i, known |= 1 << i;
  if ((known & 7) != 7) throw error(ErrorKind::input, "{}: its vertices lack x, y or z", mesh.data.path.string());
  const bool has_normals = known == 63;
  if (std::any_of(element.properties.begin(), element.properties.end(),
                  [](const PlyProperty& p) { return is_color(p.name); }))
    warnings.push_back(mesh.data.path.filename().string() + ": vertex colours are ignored");

  mesh.data.positions.reserve(element.count);
  if (has_normals) mesh.data.normals.reserve(element.count);
  for (uint64_t i = 0; i < element.count; ++i) {
    values.begin(element, i);
    double numbers[6] = {};
    for (size_t p = 0; p < slots.size(); ++p)
      if (slots[p] >= 0)
        numbers[slots[p]] = values.next(element.properties[p].type);
      else
        skip(values, element.properties[p], mesh, i);
    mesh.add_vertex({numbers[0], numbers[1], numbers[2]}, values.place(i));
    if (has_normals) mesh.add_normal({numbers[3], numbers[4], numbers[5]});
  }
}

template <typename Values>
void read_faces(Values& values, const PlyElement& element, uint64_t vertices, MeshBuilder& mesh) {
  int list = element.find("vertex_indices");
  if (list < 0) list = element.find("vertex_index");
  if (list < 0 || !element.properties[static_cast<size_t>(list)].is_list)
    throw error(ErrorKind::input, "{}: its faces have no list 'vertex_indices'", mesh.data.path.string());
  if (mesh.data.positions.size() != vertices)
    throw error(ErrorKind::input, "{}: its faces come before its vertices; write the vertices first",
                mesh.data.path.string());
  std::vector<uint32_t> corners;
  for (uint64_t i = 0; i < element.count; ++i) {
    values.begin(element, i);
    for (size_t p = 0; p < element.properties.size(); ++p) {
      const PlyProperty& property = element.properties[p];
      if (static_cast<int>(p) != list) {
        skip(values, property, mesh, i);
        continue;
      }
      const size_t count = list_length(values, property, mesh, i), place = values.place(i);
      corners.clear();
      while (corners.size() < count) corners.push_back(mesh.corner(values.next(property.type), vertices, place));
      mesh.add_face(corners, place);
    }
  }
}

template <typename Values>
void read_elements(Values& values, const PlyHeader& header, MeshBuilder& mesh, Warnings& warnings) {
  uint64_t vertices = 0;
  for (const PlyElement& element : header.elements)
    if (element.name == "vertex") vertices += element.count;
  for (const PlyElement& element : header.elements) {
    if (element.name == "vertex") {
      read_vertices(values, element, mesh, warnings);
    } else if (element.name == "face") {
      read_faces(values, element, vertices, mesh);
    } else if (element.name == "tristrips") {
      throw error(ErrorKind::input, "{}: triangle strips are not read; convert them to faces", mesh.data.path.string());
    } else {
      for (uint64_t i = 0; i < element.count; ++i) {
        values.begin(element, i);
        for (const PlyProperty& property : element.properties) skip(values, property, mesh, i);
      }
    }
  }
}

}  // namespace

MeshData read_ply(const std::filesystem::path& path, Warnings& warnings) {
  const PlyHeader header = read_ply_header(path);
  if (header.format == PlyFormat::ascii) {
    MeshBuilder mesh(path, "line");
    PlyTextValues values(path, header);
    read_elements(values, header, mesh, warnings);
    return mesh.finish(warnings);
  }
  MeshBuilder mesh(path, "face");
  PlyBinaryValues values(path, header);
  read_elements(values, header, mesh, warnings);
  return mesh.finish(warnings);
}

}  // namespace hybridrt
