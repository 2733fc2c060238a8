#pragma once

#include <filesystem>
#include <span>

#include "core/base/parallel.h"
#include "core/base/warnings.h"
#include "core/load/load_watch.h"
#include "core/load/material_kinds.h"
#include "core/scene/scene.h"
#include "core/scene/up_axis.h"

namespace hybridrt {

/// Reads one or several meshes, of any of the formats (mesh_format.h), into one validated scene with one origin
/// (assemble_scene). Large OBJs are read one after the other on all threads, the others in parallel; warnings come in
/// the meshes' order. Names of MTL files begin in `names_begin_in`, or beside each mesh if that is empty. Files whose z
/// axis points up are turned so that y points up.
///
/// Throws Error (input) before reading any if together they would take more than watch.most_bytes of memory
/// (loading_bytes.h).
Scene load_meshes(std::span<const std::filesystem::path> paths, UpAxis up, ThreadPool& pool, Warnings& warnings,
                  const LoadWatch& watch = {}, const MaterialKinds& kinds = {},
                  const std::filesystem::path& names_begin_in = {});

}  // namespace hybridrt
