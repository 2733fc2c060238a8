#pragma once

#include <filesystem>

#include "core/base/warnings.h"
#include "core/load/mesh_data.h"

namespace hybridrt {

// As in the other mesh readers, numbers are read in double, every number is checked, and memory is bounded by what the
// file holds, whatever its header promises. Throws Error (input), naming the file and the line or facet, if the file is
// missing, a directory, not of the format or cut short, and for a coordinate that is not a number below 1e30.

/// Text or binary. Facet normals only repeat the geometry and are ignored; there are three vertices per facet.
MeshData read_stl(const std::filesystem::path& path, Warnings& warnings);

}  // namespace hybridrt
