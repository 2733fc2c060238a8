#pragma once

#include <string>

#include "core/base/parallel.h"
#include "core/base/warnings.h"
#include "core/scene/scene.h"

namespace hybridrt {

/// The scene that a command's SCENE argument means: the path of an .obj file (load_obj), or a procedural
/// one (procedural.h): `scene:chess`, say, with `,triangles=N` and `,reflective=P` behind it.
/// Throws Error: usage for an unknown scene name, key or value, naming what is allowed; input for a file
/// that is missing or of a kind we do not read, and whatever load_obj() throws.
Scene load_scene(const std::string& scene_argument, ThreadPool& pool, Warnings& warnings);

}  // namespace hybridrt
