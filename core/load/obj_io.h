#pragma once

#include <filesystem>

#include "core/base/parallel.h"
#include "core/base/warnings.h"
#include "core/scene/scene.h"

namespace hybridrt {

/// Reads an OBJ and the MTL files it names into a validated scene.
///  - Positions keep the file's order, unused ones included. `origin_world` is 0 unless the scene lies farther from the
///    origin than 16 times its size.
///  - Polygons are cut into triangles; faces of fewer than three corners and triangles that repeat a
///    vertex or have no area (as floats in scene space) are left out, with a warning.
///  - Normals of the file are kept in its order, made unit; corners without a usable one get a smooth one
///    (normals.h). Smoothing groups, points, lines and vertex colours are ignored. No texture is read.
///  - Materials are those of the MTL files in their order (mtl_io.h); "default" comes first if any
///    triangle names no material or an unknown one, the latter with a warning.
/// One warning per kind of fault, with the number of cases and the first place.
///
/// Throws Error (input), naming the file and, where there is one, the line: for an unreadable file, no usable face, a
/// number or position index that is malformed or out of range, a scene too large or small for single precision.
Scene load_obj(const std::filesystem::path& path, ThreadPool& pool, Warnings& warnings);

}  // namespace hybridrt
