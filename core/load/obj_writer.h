#pragma once

#include <cstdint>
#include <filesystem>

#include "core/scene/scene.h"
#include "core/scene/up_axis.h"

namespace hybridrt {

struct WrittenObj {
  std::filesystem::path mtl;
  uint64_t obj_bytes = 0, mtl_bytes = 0;
};

/// Writes `scene` in world space, in the axes of files where `up` points up, as `path_obj` and, under the same name
/// with
/// `.mtl`, its materials (mtl_writer.h). Numbers have the fewest digits that read back the same, so load_meshes() gives
/// an equal scene: positions, normals, texture coordinates, triangles, materials, in the same order, as far as
/// triangles use them. Colours stand beside the vertices, as sRGB; a vertex with several is written several times.
/// Lights, ambient and background are not part of OBJ. Same scene, same bytes. Both files are written atomically, the
/// MTL first. Throws Error (output) when a file cannot be written, Error (usage) when `path_obj` does not end in .obj.
WrittenObj write_obj(const Scene& scene, const std::filesystem::path& path_obj, UpAxis up = UpAxis::y);

}  // namespace hybridrt
