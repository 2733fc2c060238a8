#pragma once

#include <filesystem>

#include "core/load/scene_source.h"

namespace hybridrt {

/// Whether SCENE names a scene JSON.
bool is_scene_file(const std::filesystem::path& path);

/// Reads what a scene JSON says, no mesh; `path` becomes the argument. Mesh paths are as found from the JSON's folder.
/// Throws Error (input) naming file and place: what read_json_file throws, unknown keys, values of the wrong kind, no
/// mesh, too many lights, other lights than directional ones, both a camera and a camera path.
SceneSource read_scene_file(const std::filesystem::path& path);

/// The camera of such a source ("camera", or "camera_path" as an object or the name of a file beside it), if it has
/// one. Apart from the rest, since it needs to know what the command line makes of the up axis.
std::optional<CameraCourse> scene_file_camera(const SceneSource& source, UpAxis up, Warnings& warnings);

}  // namespace hybridrt
