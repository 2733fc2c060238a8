#pragma once

#include <optional>
#include <string>

#include "core/base/parallel.h"
#include "core/base/warnings.h"
#include "core/load/load_watch.h"
#include "core/scene/scene.h"
#include "core/scene/up_axis.h"

namespace hybridrt {

/// The scene that a command's SCENE argument means: the path of a mesh file or of a scene JSON that names
/// several (load_meshes), or a procedural one (procedural.h): `scene:chess`, say, with `,triangles=N` and
/// `,reflective=P` behind it.
/// Throws Error: usage for an unknown scene name, key or value, naming what is allowed; input for a file
/// that is missing or of a kind we do not read, and whatever load_meshes() and read_scene_file() throw.
/// `up_axis` replaces what a scene JSON says; procedural scenes have y up and take no other.
/// A scene that would take more than watch.most_bytes of memory is refused (Error, input) before it is read or made.
Scene load_scene(const std::string& scene_argument, ThreadPool& pool, Warnings& warnings,
                 std::optional<UpAxis> up_axis = std::nullopt, const LoadWatch& watch = {});

}  // namespace hybridrt
