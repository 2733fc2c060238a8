#pragma once

#include <filesystem>

#include "core/base/warnings.h"
#include "core/load/mesh_data.h"

namespace hybridrt {

// As in the other mesh readers, numbers are read in double, every number and index is checked, and memory is bounded by
// what the file holds, whatever its header promises. Throws Error (input), naming the file and the line or element, if
// the file is missing, a directory, not of the format or cut short, for a face with a coordinate that is not a number
// below 1e30, and for an index without a vertex.
//
// Why not OpenMesh's readers (tried at 9.0): they keep single precision only (a scene 1e7 from the origin collapses),
// read NaN, a misspelt number and whatever follows it as 0 and report success, do not read PLY coordinates given as
// whole numbers, and drop STL's degenerate facets silently. Checking the text first would take the same parser.

/// Text, or binary in either byte order. Faces, which may come before the vertices, and triangle strips (one list or
/// several, -1 between strips). Polygons are cut into triangles, vertex normals kept, colours left out with a
/// warning, texture coordinates and other elements and properties skipped.
MeshData read_ply(const std::filesystem::path& path, Warnings& warnings);

}  // namespace hybridrt
