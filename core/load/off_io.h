#pragma once

#include <filesystem>

#include "core/base/warnings.h"
#include "core/load/mesh_data.h"

namespace hybridrt {

// As the other mesh readers here: numbers are read in double, every one of them and every index is checked, and memory
// is bounded by what the file really holds, whatever its header promises. Throws Error (input) naming the file and the
// line or element: missing, a directory, not of the format, cut short, a coordinate that is none or not below 1e30, an
// index that is not a vertex.

/// Text: polygons are cut, vertex normals kept, colours left out with a warning.
MeshData read_off(const std::filesystem::path& path, Warnings& warnings);

}  // namespace hybridrt
