#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "core/base/warnings.h"

namespace hybridrt {

/// An OM file whose counts and sizes have been checked, with the chunks that we read and no others: OpenMesh's own
/// reader trusts every number.
struct OmFile {
  std::string bytes;  ///< header, chunks, end mark: an OM file
  char kind = 'T';    ///< triangles, quads or polygons
  uint32_t vertices = 0, faces = 0, edges = 0;
  bool by_halfedges = false;  ///< version 2: faces are cycles of half-edges; else lists of vertices
  bool normals = false, vertex_colors = false, face_colors = false;
};

/// What the header promises, no more than the file's size allows; for estimates. Throws Error(input).
struct OmCounts {
  uint64_t vertices = 0, faces = 0;
};
OmCounts read_om_counts(const std::filesystem::path& path);

/// Binary, little-endian, versions 1.0 to 2.2 (OpenMesh's OMFormat.hh describes it). Kept: positions, normals and 8-bit
/// colours of vertices, colours of faces, topology. Left out, with a warning: texture coordinates (OM names no
/// texture), properties of the writer's own, status bits, and chunks of other kinds. Throws Error(input) if the file is
/// missing, not OM, cut short, of a later version, without positions or faces, or holds a chunk twice.
OmFile read_om_chunks(const std::filesystem::path& path, Warnings& warnings);

}  // namespace hybridrt
