#include "core/load/ply_io.h"

#include <array>

#include "core/base/error.h"
#include "core/load/mesh_builder.h"
#include "core/load/mesh_colors.h"
#include "core/load/ply_attributes.h"
#include "core/load/ply_face_extras.h"
#include "core/load/ply_lists.h"
#include "core/load/ply_textures.h"
#include "core/load/ply_values.h"

namespace hybridrt {
namespace {

template <typename Values>
void read_vertices(Values& values, const PlyElement& element, bool textured, MeshBuilder& mesh, Warnings& warnings) {
  using Layout = PlyVertexLayout;
  const Layout layout = vertex_layout(element, textured, mesh.data.path, warnings);
  mesh.data.positions.reserve(element.count);
  if (layout.has_normals) mesh.data.normals.reserve(element.count);
  if (layout.has_color) mesh.data.colors.reserve(element.count), mesh.data.color_full = layout.color.full;
  if (layout.has_texcoord) mesh.data.texcoords.reserve(element.count);
  std::array<double, Layout::kNumbers> numbers{};
  const auto three_at = [&](size_t at) { return dvec3(numbers[at], numbers[at + 1], numbers[at + 2]); };
  for (uint64_t i = 0; i < element.count; ++i) {
    values.begin(element, i);
    for (size_t p = 0; p < layout.slots.size(); ++p)
      if (layout.slots[p] >= 0)
        numbers[static_cast<size_t>(layout.slots[p])] = values.next(element.properties[p].type);
      else
        skip(values, element.properties[p], mesh, i);
    mesh.add_vertex(three_at(Layout::kX), values.place(i));
    if (layout.has_normals) mesh.add_normal(three_at(Layout::kNormal));
    if (layout.has_color) mesh.data.colors.push_back(color_of_numbers(three_at(Layout::kRed)));
    if (layout.has_alpha) mesh.add_alpha(numbers[Layout::kAlpha], layout.color.full_alpha, values.place(i));
    if (layout.has_texcoord) mesh.add_texcoord({numbers[Layout::kU], numbers[Layout::kU + 1]}, values.place(i));
  }
}

template <typename Values>
void read_faces(Values& values, const PlyElement& element, uint64_t vertices,
                const std::vector<uint32_t>& texture_materials, MeshBuilder& mesh, Warnings& warnings) {
  int list = element.find("vertex_indices");
  if (list < 0) list = element.find("vertex_index");
  if (list < 0 || !element.properties[static_cast<size_t>(list)].is_list)
    throw error(ErrorKind::input, "{}: its faces have no list 'vertex_indices'", mesh.data.path.string());
  if (mesh.data.positions.size() != vertices)
    throw error(ErrorKind::input, "{}: its faces come before its vertices; write the vertices first",
                mesh.data.path.string());
  FaceExtrasReader extras(values, element, texture_materials, mesh, warnings);
  std::vector<uint32_t> corners;
  for (uint64_t i = 0; i < element.count; ++i) {
    values.begin(element, i);
    extras.begin();
    corners.clear();
    for (size_t p = 0; p < element.properties.size(); ++p) {
      if (static_cast<int>(p) != list) {
        extras.read(p, i);
        continue;
      }
      const PlyProperty& property = element.properties[p];
      const size_t count = list_length(values, property, mesh, i), place = values.place(i);
      while (corners.size() < count) corners.push_back(mesh.corner(values.next(property.type), vertices, place));
    }
    mesh.add_face(corners, values.place(i), extras.finish(corners.size(), values.place(i)));
  }
  extras.report_unknown(warnings);
}

template <typename Values>
void read_elements(Values& values, const PlyHeader& header, MeshBuilder& mesh, Warnings& warnings) {
  const std::vector<uint32_t> texture_materials = use_textures(header, mesh.data, warnings);
  uint64_t vertices = 0;
  for (const PlyElement& element : header.elements)
    if (element.name == "vertex") vertices += element.count;
  for (const PlyElement& element : header.elements) {
    if (element.name == "vertex") {
      read_vertices(values, element, !texture_materials.empty(), mesh, warnings);
    } else if (element.name == "face") {
      read_faces(values, element, vertices, texture_materials, mesh, warnings);
    } else if (element.name == "tristrips") {
      throw error(ErrorKind::input, "{}: triangle strips are not read; convert them to faces", mesh.data.path.string());
    } else {
      if (element.name.find("texture") != std::string::npos || element.name.find("material") != std::string::npos)
        warnings.push_back(fmt::format("{}: its elements {} are not read", mesh.data.path.filename().string(),
                                       in_quotes(element.name)));
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
