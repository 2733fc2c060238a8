#pragma once

#include <cstdint>
#include <vector>

#include "core/base/warnings.h"
#include "core/load/mesh_data.h"
#include "core/load/ply_header.h"

namespace hybridrt {

/// Gives the mesh a material for each different texture of the header, called as it, with Kd 1 and a map_Kd, and
/// returns the number of each texture's material. Files are looked for beside the PLY, as find_file.h says; warnings
/// name those that are missing or found under another name. Empty, with a warning, if there are textures without
/// texture coordinates or the other way round.
std::vector<uint32_t> use_textures(const PlyHeader& header, MeshData& mesh, Warnings& warnings);

}  // namespace hybridrt
