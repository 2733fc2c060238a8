#pragma once

#include <cstdint>
#include <exception>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/warnings.h"
#include "core/load/bad_vertices.h"
#include "core/load/mesh_data.h"
#include "core/load/text_scan.h"

namespace hybridrt {

/// How many statements of each kind an OBJ file has up to some place.
struct ObjCounts {
  size_t lines = 0, vertices = 0, texcoords = 0, normals = 0, faces = 0;

  ObjCounts& operator+=(const ObjCounts& more) {
    lines += more.lines, vertices += more.vertices, texcoords += more.texcoords;
    normals += more.normals, faces += more.faces;
    return *this;
  }
};

/// Whole lines of an OBJ file and their contents. Chunks can be read on any thread in any order, as each knows the
/// counts before it: indices and line numbers are those of the file.
struct ObjChunk {
  std::string_view text;
  ObjCounts before;  ///< the counts of the file before this chunk

  // The mesh of this chunk alone. Material 0 is the one that the previous chunk ends with; `material_names` are those
  // of this chunk, and the last one named is `last_material`. Polygons of more than three corners are in `polygons`;
  // `data` has room for their triangles.
  MeshData data;
  uint32_t last_material = 0;

  struct Corner {
    uint32_t position, texcoord, normal;
  };
  struct Polygon {
    size_t first_triangle, first_corner;
    uint32_t corners, line;
    uint32_t farthest;  ///< the largest position index
  };
  std::vector<Polygon> polygons;
  std::vector<Corner> polygon_corners;

  /// An index that points ahead, which is allowed if such a vertex follows.
  struct Ahead {
    int32_t index = 0;
    uint32_t line = 0;
  };
  Ahead farthest;  ///< the largest position index; the first of several
  std::vector<Ahead> texcoords_ahead, normals_ahead;
  std::vector<BadVertex> bad_vertices;
  std::vector<uint32_t> polypaint;  ///< the colours of #MRGB comments, 0xMMRRGGBB each, for the vertices in order
  Tally unread_texcoords, bad_texcoords, bad_normals, small_faces, unknown, bad_colors, bad_polypaint;

  std::exception_ptr failure;  ///< the error that ended reading
};

/// Counts the statements of `text`, as far as its lines can be read.
ObjCounts count_statements(const std::filesystem::path& path, std::string_view text);

/// Reads chunk.text into the rest of it. Checks every number and index: `v` has three numbers, and those that are not
/// finite or not below 1e30 are listed, and a colour if three more follow; an unreadable `vn` or `vt` becomes zero, and
/// the caller rebuilds such normals; `f` has corners v, v/vt, v//vn or v/vt/vn, v not 0 and not before the first
/// vertex; a vt or vn out of range is left out. Errors end in chunk.failure: Error (input) naming file and line.
void read_chunk(const std::filesystem::path& path, ObjChunk& chunk);

}  // namespace hybridrt
