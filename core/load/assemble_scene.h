#pragma once

#include <string>
#include <vector>

#include "core/base/parallel.h"
#include "core/base/warnings.h"
#include "core/load/load_watch.h"
#include "core/load/mesh_data.h"
#include "core/scene/material.h"
#include "core/scene/scene.h"

namespace hybridrt {

/// A file's mesh and the materials that it names.
struct LoadedMesh {
  MeshData data;
  std::vector<Material> library;
  std::vector<std::string> library_files;  ///< the MTL files that were read
};

/// Makes one validated scene of one or several meshes, in their order.
///  - `origin_world` is 0 unless the scene lies farther from the origin than 16 times its size.
///  - Triangles that repeat a vertex or have no area (as floats in scene space) are left out, with a warning.
///  - Usable normals are kept in their order; the other corners get smooth ones (normals.h).
///  - Each mesh's materials follow one another; "default" comes first if any triangle names no material or an
///    unknown one, the latter with a warning.
///  - Where a mesh names no material and its MTL files have only one, that is used, with a warning.
///  - Colours of vertices and faces are kept as mesh_colors.h says.
///  - Materials that cannot be seen are told of (invisible.h).
///  - Textures are read by watch.textures (load_textures.h). Texture coordinates are kept only for them.
/// Throws Error (input) for a mesh without a usable face and for a scene too large or small for single precision.
Scene assemble_scene(std::vector<LoadedMesh> meshes, ThreadPool& pool, Warnings& warnings, const LoadWatch& watch = {});

}  // namespace hybridrt
