#include "core/load/loading_bytes.h"

#include <algorithm>
#include <array>
#include <fstream>

#include "core/base/error.h"
#include "core/base/memory.h"
#include "core/load/mesh_format.h"
#include "core/load/ply_attributes.h"
#include "core/load/ply_header.h"
#include "core/load/text_lines.h"
#include "core/load/text_scan.h"

namespace hybridrt {
namespace {

namespace fs = std::filesystem;

// At the peak: positions in double and float, smooth normals and what building them takes; four arrays of indices.
constexpr uint64_t kBytesPerVertex = 72, kBytesPerTriangle = 44;
// More with colours or texture coordinates: twice while they are handed on, and their indices.
constexpr uint64_t kBytesPerColor = 24, kBytesPerIndices = 24;
// An OBJ of a million triangles with normals takes 2.5 times its text, one without them 3.6 times.
constexpr uint64_t kBytesPerObjByte = 4, kBytesPerTextStlByte = 2;
constexpr uint64_t kMadeBytesPerTriangle = 90;  // measured on balls of two million triangles

uint64_t mesh_bytes(uint64_t vertices, uint64_t triangles) {
  return vertices * kBytesPerVertex + triangles * kBytesPerTriangle;
}

uint64_t ply_bytes(const fs::path& path) {
  const PlyHeader header = read_ply_header(path);  // checks the counts against the file's size
  uint64_t vertices = 0, faces = 0, colors = 0, texcoords = 0;
  for (const PlyElement& element : header.elements) {
    if (element.name == "vertex") vertices += element.count;
    if (element.name == "face") faces += element.count;
    if (find_color(element).complete()) colors += element.count;
    if (element.name == "face" && has_corner_texcoords(element)) texcoords += 3 * element.count;
    if (element.name == "vertex" && find_texcoord(element)[0] >= 0) texcoords += element.count;
  }
  if (header.textures.empty()) texcoords = 0;  // they are not read
  return mesh_bytes(vertices, faces) + (colors + texcoords) * kBytesPerColor +
         ((colors > 0) + (texcoords > 0)) * faces * kBytesPerIndices;
}

uint64_t off_bytes(const fs::path& path, uint64_t file_bytes) {
  TextLines lines(path, LineJoin::none);
  uint64_t counts[2] = {0, 0};
  size_t found = 0;
  for (std::string_view line; found < 2 && lines.next(line);) {
    std::string_view rest = line.substr(0, line.find('#'));
    for (std::string_view word = take_word(rest); found < 2 && !word.empty(); word = take_word(rest)) {
      const std::optional<double> number = parse_number(word);
      if (!number && found > 0) return 0;
      if (number && *number >= 0) counts[found++] = static_cast<uint64_t>(std::min(*number, 1e18));
    }
  }
  // Two bytes per number, three numbers per vertex; the reader refuses more.
  return mesh_bytes(std::min(counts[0], file_bytes / 6), std::min(counts[1], file_bytes / 2));
}

uint64_t stl_bytes(const fs::path& path, uint64_t file_bytes) {
  std::array<char, 5> start{};
  std::ifstream(path, std::ios::binary).read(start.data(), start.size());
  const bool text =
      std::string_view(start.data(), start.size()) == "solid";  // true of some binary files too, which does no harm
  const uint64_t facets = (file_bytes - std::min<uint64_t>(file_bytes, 84)) / 50;
  return text ? file_bytes * kBytesPerTextStlByte : mesh_bytes(3 * facets, facets);
}

}  // namespace

uint64_t loading_bytes(const fs::path& path) {
  std::error_code unreadable;
  const uint64_t file_bytes = fs::file_size(path, unreadable);
  if (unreadable) return 0;
  try {
    switch (mesh_format_of(path)) {
      case MeshFormat::ply: return ply_bytes(path);
      case MeshFormat::off: return off_bytes(path, file_bytes);
      case MeshFormat::stl: return stl_bytes(path, file_bytes);
      case MeshFormat::obj: return file_bytes * kBytesPerObjByte;
    }
  } catch (const Error&) {  // the reader will report it, with more detail
  }
  return 0;
}

uint64_t making_bytes(int64_t triangles) {
  return triangles > 0 ? static_cast<uint64_t>(triangles) * kMadeBytesPerTriangle : 0;
}

void require_room_for_scene(const std::string& what, uint64_t bytes, uint64_t most_bytes) {
  if (bytes > most_bytes)
    throw error(ErrorKind::input,
                "{}: the scene needs about {} of memory, but {} are allowed; use a smaller scene or raise --max-memory",
                what, size_text(bytes), size_text(most_bytes));
}

}  // namespace hybridrt
