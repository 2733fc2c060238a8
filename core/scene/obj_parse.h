#pragma once

#include <filesystem>

#include "core/base/warnings.h"
#include "core/scene/mesh_data.h"

namespace hybridrt {

/// Reads through tinyobjloader, behind ObjFilter. Throws Error (input) naming file and line; warnings say
/// what was left out.
MeshData parse_obj(const std::filesystem::path& path, Warnings& warnings);

}  // namespace hybridrt
