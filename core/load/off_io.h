#pragma once

#include <filesystem>

#include "core/base/warnings.h"
#include "core/load/mesh_data.h"

namespace hybridrt {

// As in the other mesh readers, numbers are read in double, every number and index is checked, and memory is bounded by
// what the file holds, whatever its header promises. Throws Error (input), naming the file and the line or element, if
// the file is missing, a directory, not of the format or cut short, for a face with a coordinate that is not a number
// below 1e30, and for an index without a vertex.

/// Text, with or without the keyword (off_header.h). Polygons are cut into triangles, vertex normals kept, colours left
/// out with a warning.
MeshData read_off(const std::filesystem::path& path, Warnings& warnings);

}  // namespace hybridrt
