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

/// Faces that come before their vertices: polygons cannot be cut yet.
struct WaitingFaces {
  struct Face {
    uint32_t corners = 0;
    bool has_texcoords = false;
    MeshBuilder::FaceExtras extras;  ///< but for its texcoords
    size_t place = 0;
  };
  std::vector<Face> faces;
  std::vector<uint32_t> corners, texcoords;  ///< one face after the other; those of faces that have some

  void add(std::span<const uint32_t> of_corners, size_t place, MeshBuilder::FaceExtras extras) {
    corners.insert(corners.end(), of_corners.begin(), of_corners.end());
    texcoords.insert(texcoords.end(), extras.texcoords.begin(), extras.texcoords.end());
    const bool has_texcoords = !extras.texcoords.empty();
    extras.texcoords = {};
    faces.push_back({static_cast<uint32_t>(of_corners.size()), has_texcoords, extras, place});
  }
};

void add_waiting(const WaitingFaces& waiting, MeshBuilder& mesh) {
  const uint32_t *corners = waiting.corners.data(), *texcoords = waiting.texcoords.data();
  for (const WaitingFaces::Face& face : waiting.faces) {
    MeshBuilder::FaceExtras extras = face.extras;
    if (face.has_texcoords) extras.texcoords = {texcoords, face.corners};
    mesh.add_face({corners, face.corners}, face.place, extras);
    corners += face.corners;
    texcoords += extras.texcoords.size();
  }
}

/// The list of corners of an element. Throws Error (input) if there is none.
size_t corner_list(const PlyElement& element, const MeshBuilder& mesh) {
  const int list = element.find_corners();
  if (list < 0)
    throw error(ErrorKind::input, "{}: its {}s have no list 'vertex_indices'; export the mesh again",
                mesh.data.path.string(), element.name == "face" ? "face" : "strip");
  return static_cast<size_t>(list);
}

template <typename Values>
void read_faces(Values& values, const PlyElement& element, uint64_t vertices,
                const std::vector<uint32_t>& texture_materials, MeshBuilder& mesh, WaitingFaces& waiting,
                Warnings& warnings) {
  const size_t list = corner_list(element, mesh);
  const bool must_wait = mesh.data.positions.size() != vertices;
  FaceExtrasReader reader(values, element, texture_materials, mesh, warnings);
  std::vector<uint32_t> corners;
  for (uint64_t i = 0; i < element.count; ++i) {
    values.begin(element, i);
    reader.begin();
    corners.clear();
    const size_t place = values.place(i);
    for (size_t p = 0; p < element.properties.size(); ++p) {
      if (p != list) {
        reader.read(p, i);
        continue;
      }
      const PlyProperty& property = element.properties[p];
      const size_t count = list_length(values, property, mesh, i);
      while (corners.size() < count) corners.push_back(mesh.corner(values.next(property.type), vertices, place));
    }
    const MeshBuilder::FaceExtras extras = reader.finish(corners.size(), place);
    if (must_wait)
      waiting.add(corners, place, extras);
    else
      mesh.add_face(corners, place, extras);
  }
  reader.report_unknown(warnings);
}

/// Whether a number of a strip list starts a new strip: -1, as an unsigned number too.
bool restarts(double number, PlyType type, uint64_t vertices) {
  if (number == -1) return true;
  const double largest = type == PlyType::uint8 ? 255 : type == PlyType::uint16 ? 65535 : 4294967295.0;
  const bool is_unsigned = type == PlyType::uint8 || type == PlyType::uint16 || type == PlyType::uint32;
  return is_unsigned && number == largest && largest >= static_cast<double>(vertices);
}

/// One list of strips: each corner after two others makes a triangle, which faces the same way as the one before.
template <typename Values>
void read_strips(Values& values, const PlyProperty& property, uint64_t vertices, uint64_t index,
                 const MeshBuilder::FaceExtras& extras, MeshBuilder& mesh) {
  const size_t count = list_length(values, property, mesh, index, kMostInStrips);
  std::array<uint32_t, 3> last{};
  size_t length = 0;  // of this strip
  const auto place = [&] { return values.place(mesh.data.faces); };
  const auto end_strip = [&] {
    if (length == 1 || length == 2) mesh.add_face(std::span(last).first(length), place());
    length = 0;
  };
  for (size_t i = 0; i < count; ++i) {
    const double number = values.next(property.type);
    if (restarts(number, property.type, vertices)) {
      end_strip();
      continue;
    }
    last = {last[1], last[2], mesh.corner(number, vertices, place())};
    if (++length < 3) continue;
    const auto [a, b, c] = last;
    if (a == b || b == c || c == a) continue;  // no triangle: strips turn corners this way
    mesh.add_face(length % 2 == 1 ? std::array{a, b, c} : std::array{b, a, c}, place(), extras);
  }
  end_strip();
}

template <typename Values>
void read_tristrips(Values& values, const PlyElement& element, uint64_t vertices,
                    const std::vector<uint32_t>& texture_materials, MeshBuilder& mesh) {
  MeshBuilder::FaceExtras extras;
  if (!texture_materials.empty()) extras.material = texture_materials[0];
  const size_t list = corner_list(element, mesh);
  for (uint64_t i = 0; i < element.count; ++i) {
    values.begin(element, i);
    for (size_t p = 0; p < element.properties.size(); ++p)
      if (p == list)
        read_strips(values, element.properties[p], vertices, i, extras, mesh);
      else
        skip(values, element.properties[p], mesh, i);
  }
}

template <typename Values>
void read_elements(Values& values, const PlyHeader& header, MeshBuilder& mesh, Warnings& warnings) {
  const std::vector<uint32_t> texture_materials = use_textures(header, mesh.data, warnings);
  uint64_t vertices = 0;
  for (const PlyElement& element : header.elements)
    if (element.name == "vertex") vertices += element.count;
  WaitingFaces waiting;
  for (const PlyElement& element : header.elements) {
    if (element.name == "vertex") {
      read_vertices(values, element, !texture_materials.empty(), mesh, warnings);
    } else if (element.name == "face") {
      read_faces(values, element, vertices, texture_materials, mesh, waiting, warnings);
    } else if (element.name == "tristrips") {
      read_tristrips(values, element, vertices, texture_materials, mesh);
    } else {
      if (element.name.find("texture") != std::string::npos || element.name.find("material") != std::string::npos)
        warnings.emplace_back(WarningCode::data_unread,
                              fmt::format("{}: its elements {} are not read", mesh.data.path.filename().string(),
                                          in_quotes(element.name)));
      for (uint64_t i = 0; i < element.count; ++i) {
        values.begin(element, i);
        for (const PlyProperty& property : element.properties) skip(values, property, mesh, i);
      }
    }
  }
  add_waiting(waiting, mesh);
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
