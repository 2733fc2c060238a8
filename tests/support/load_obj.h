#pragma once

#include "core/load/mesh_io.h"

namespace hybridrt {

/// One OBJ with its MTL files as a scene, y up, without textures.
inline Scene load_obj(const std::filesystem::path& path, ThreadPool& pool, Warnings& warnings) {
  return load_meshes({&path, 1}, UpAxis::y, pool, warnings);
}

}  // namespace hybridrt
