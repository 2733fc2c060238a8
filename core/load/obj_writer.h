#pragma once

#include <cstdint>
#include <filesystem>

#include "core/scene/scene.h"

namespace hybridrt {

struct WrittenObj {
  std::filesystem::path mtl;
  uint64_t obj_bytes = 0, mtl_bytes = 0;
};

/// Writes `scene` in world space as `path_obj` and, under the same name with `.mtl`, its materials (as resolved).
/// Numbers have the fewest digits that read back the same, so load_meshes() gives an equal scene: positions, normals,
/// triangles, materials, in the same order. Lights, ambient and background are not part of OBJ. Same scene, same bytes.
/// Both files are written atomically, the MTL first. Throws Error (output) when a file cannot be written, Error (usage)
/// when `path_obj` does not end in .obj.
WrittenObj write_obj(const Scene& scene, const std::filesystem::path& path_obj);

}  // namespace hybridrt
