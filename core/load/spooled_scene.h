#pragma once

#include "core/base/named.h"
#include "core/load/mesh_format.h"
#include "core/load/scene_source.h"

namespace hybridrt {

inline constexpr Named<MeshFormat> kMeshFormatNames[] = {{"obj", MeshFormat::obj},
                                                         {"ply", MeshFormat::ply},
                                                         {"off", MeshFormat::off},
                                                         {"stl", MeshFormat::stl},
                                                         {"om", MeshFormat::om}};

/// The mesh that standard input ("-") or a descriptor that the caller gave (/dev/fd/63, the shell's <(...)) brings.
/// Readers need a file, so it goes into a temporary one, which is removed with the
/// last copy of the result; names in it begin in the working directory. Throws Error(input) if nothing comes,
/// Error(output) if it cannot be kept.
SceneSource read_piped_scene(const std::string& argument, MeshFormat format);

}  // namespace hybridrt
