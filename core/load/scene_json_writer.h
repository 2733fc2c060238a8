#pragma once

#include <filesystem>

#include "core/scene/scene.h"
#include "core/scene/scene_shot.h"

namespace hybridrt {

/// Writes `path_json`: a scene of the one mesh `mesh` (a path relative to it) seen as `shot` says. Same arguments, same
/// bytes; written atomically. Throws Error (output) when it cannot be written.
void write_scene_json(const std::filesystem::path& path_json, const std::string& mesh, const SceneShot& shot);

}  // namespace hybridrt
