#pragma once

#include <filesystem>

#include "core/base/warnings.h"
#include "core/load/mesh_data.h"

namespace hybridrt {

// As in the other mesh readers, numbers are read in double, every number is checked, and memory is bounded by what the
// file holds, whatever its header promises. Throws Error (input), naming the file and the line or facet, if the file is
// missing, a directory, not of the format or cut short, and if no facet has coordinates that are numbers below 1e30.

/// Text or binary. Facet normals only repeat the geometry and are ignored; there are three vertices per facet. Left out
/// or repaired with a warning: facets with a coordinate that is no number below 1e30, a missing `endsolid`, and a
/// binary count of 0 or 2^32 - 1, for which the size speaks.
MeshData read_stl(const std::filesystem::path& path, Warnings& warnings);

/// Whether the file begins like text. False if it cannot be read.
bool is_text_stl(const std::filesystem::path& path);

}  // namespace hybridrt
