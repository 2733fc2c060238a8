#include "core/load/loading_bytes.h"

#include <algorithm>

#include "core/base/error.h"
#include "core/base/memory.h"
#include "core/load/mesh_builder.h"
#include "core/load/mesh_format.h"
#include "core/load/off_header.h"
#include "core/load/om_chunks.h"
#include "core/load/ply_attributes.h"
#include "core/load/ply_header.h"
#include "core/load/stl_io.h"

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

uint64_t ply_bytes(const fs::path& path, uint64_t file_bytes) {
  const PlyHeader header = read_ply_header(path);  // checks the counts against the file's size
  uint64_t vertices = 0, faces = 0, colors = 0, texcoords = 0, other_bytes = header.bytes, index_bytes = 0;
  for (const PlyElement& element : header.elements) {
    if (element.name == "vertex") vertices += element.count;
    if (element.name == "face") faces += element.count;
    if (find_color(element).complete()) colors += element.count;
    if (element.name == "face" && has_corner_texcoords(element)) texcoords += 3 * element.count;
    if (element.name == "vertex" && find_texcoord(element)[0] >= 0) texcoords += element.count;
    other_bytes += element.count * least_bytes(element, header.format);
    if (const int list = element.find_corners(); list >= 0 && element.name == "tristrips")
      index_bytes = header.format == PlyFormat::ascii ? 2 : size_of(element.properties[static_cast<size_t>(list)].type);
  }
  if (index_bytes > 0) faces += (file_bytes - std::min(file_bytes, other_bytes)) / index_bytes;  // a triangle per index
  if (header.textures.empty()) texcoords = 0;                                                    // they are not read
  return mesh_bytes(vertices, faces) + (colors + texcoords) * kBytesPerColor +
         ((colors > 0) + (texcoords > 0)) * faces * kBytesPerIndices;
}

uint64_t off_bytes(const fs::path& path, uint64_t file_bytes) {
  const MeshBuilder mesh(path, "line");
  OffLines lines(path, mesh);
  const OffHeader header = read_off_header(lines, mesh, static_cast<double>(file_bytes));
  // Two bytes per number, three numbers per vertex; the reader refuses more.
  return mesh_bytes(std::min<uint64_t>(header.vertices, file_bytes / 6),
                    std::min<uint64_t>(header.faces, file_bytes / 2));
}

uint64_t om_bytes(const fs::path& path, uint64_t file_bytes) {
  const OmCounts counts = read_om_counts(path);
  return 6 * file_bytes + mesh_bytes(counts.vertices, 2 * counts.faces);  // the file, what is kept of it, and its parts
}

uint64_t stl_bytes(const fs::path& path, uint64_t file_bytes) {
  const uint64_t facets = (file_bytes - std::min<uint64_t>(file_bytes, 84)) / 50;
  return is_text_stl(path) ? file_bytes * kBytesPerTextStlByte : mesh_bytes(3 * facets, facets);
}

}  // namespace

uint64_t loading_bytes(const fs::path& path) {
  std::error_code unreadable;
  const uint64_t file_bytes = fs::file_size(path, unreadable);
  if (unreadable) return 0;
  try {
    switch (mesh_format_of(path)) {
      case MeshFormat::ply: return ply_bytes(path, file_bytes);
      case MeshFormat::off: return off_bytes(path, file_bytes);
      case MeshFormat::stl: return stl_bytes(path, file_bytes);
      case MeshFormat::om: return om_bytes(path, file_bytes);
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
