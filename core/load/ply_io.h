#pragma once

#include <filesystem>

#include "core/base/warnings.h"
#include "core/load/mesh_data.h"

namespace hybridrt {

// As the other mesh readers here: numbers are read in double, every one of them and every index is checked, and memory
// is bounded by what the file really holds, whatever its header promises. Throws Error (input) naming the file and the
// line or element: missing, a directory, not of the format, cut short, a coordinate that is none or not below 1e30, an
// index that is not a vertex.
//
// Ours and not OpenMesh's readers, tried at 9.0: those keep single precision only (a scene 1e7 from the origin
// collapses), take NaN, a misspelt number and whatever follows it for 0 and report success, read nothing of PLY
// coordinates given as whole numbers, and leave out STL's degenerate facets uncounted; feeding them checked text would
// take the same parser in front.

/// Text, or binary of either byte order, as written: polygons are cut, vertex normals kept, colours left out with a
/// warning, texture coordinates and other elements and properties skipped.
MeshData read_ply(const std::filesystem::path& path, Warnings& warnings);

}  // namespace hybridrt
