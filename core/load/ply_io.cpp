#include "core/load/ply_io.h"

#include <algorithm>
#include <array>

#include "core/base/error.h"
#include "core/load/mesh_builder.h"
#include "core/load/ply_values.h"

namespace hybridrt {
namespace {

constexpr double kMostListed = 1 << 20;       // corners of one polygon, numbers of any other list
constexpr double kMostInStrips = 1ull << 32;  // Lucy is one list of thirty million

bool is_color(std::string_view property) { return property == "red" || property == "r" || property == "diffuse_red"; }

/// Reads the length of the next list.
template <typename Values>
size_t list_length(Values& values, const PlyProperty& property, const MeshBuilder& mesh, uint64_t index,
                   double most = kMostListed) {
  const double count = values.next(property.count_type);
  if (!(count >= 0 && count <= most && count == std::floor(count)))
    mesh.fail(values.place(index), fmt::format("a list of {:g} numbers; there must be 0 to {}", count, most));
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

/// Faces that come before their vertices: polygons cannot be cut yet.
struct WaitingFaces {
  std::vector<uint32_t> corners;
  std::vector<uint32_t> sizes;
  std::vector<size_t> places;
};

void add_waiting(const WaitingFaces& waiting, MeshBuilder& mesh) {
  const uint32_t* first = waiting.corners.data();
  for (size_t i = 0; i < waiting.sizes.size(); first += waiting.sizes[i++])
    mesh.add_face({first, waiting.sizes[i]}, waiting.places[i]);
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
void read_faces(Values& values, const PlyElement& element, uint64_t vertices, MeshBuilder& mesh,
                WaitingFaces& waiting) {
  const size_t list = corner_list(element, mesh);
  const bool must_wait = mesh.data.positions.size() != vertices;
  std::vector<uint32_t> corners;
  for (uint64_t i = 0; i < element.count; ++i) {
    values.begin(element, i);
    for (size_t p = 0; p < element.properties.size(); ++p) {
      const PlyProperty& property = element.properties[p];
      if (p != list) {
        skip(values, property, mesh, i);
        continue;
      }
      const size_t count = list_length(values, property, mesh, i), place = values.place(i);
      corners.clear();
      while (corners.size() < count) corners.push_back(mesh.corner(values.next(property.type), vertices, place));
      if (must_wait) {
        waiting.corners.insert(waiting.corners.end(), corners.begin(), corners.end());
        waiting.sizes.push_back(static_cast<uint32_t>(count));
        waiting.places.push_back(place);
      } else {
        mesh.add_face(corners, place);
      }
    }
  }
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
void read_strips(Values& values, const PlyProperty& property, uint64_t vertices, uint64_t index, MeshBuilder& mesh) {
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
    mesh.add_face(length % 2 == 1 ? std::array{a, b, c} : std::array{b, a, c}, place());
  }
  end_strip();
}

template <typename Values>
void read_tristrips(Values& values, const PlyElement& element, uint64_t vertices, MeshBuilder& mesh) {
  const size_t list = corner_list(element, mesh);
  for (uint64_t i = 0; i < element.count; ++i) {
    values.begin(element, i);
    for (size_t p = 0; p < element.properties.size(); ++p)
      if (p == list)
        read_strips(values, element.properties[p], vertices, i, mesh);
      else
        skip(values, element.properties[p], mesh, i);
  }
}

template <typename Values>
void read_elements(Values& values, const PlyHeader& header, MeshBuilder& mesh, Warnings& warnings) {
  uint64_t vertices = 0;
  for (const PlyElement& element : header.elements)
    if (element.name == "vertex") vertices += element.count;
  WaitingFaces waiting;
  for (const PlyElement& element : header.elements) {
    if (element.name == "vertex") {
      read_vertices(values, element, mesh, warnings);
    } else if (element.name == "face") {
      read_faces(values, element, vertices, mesh, waiting);
    } else if (element.name == "tristrips") {
      read_tristrips(values, element, vertices, mesh);
    } else {
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
