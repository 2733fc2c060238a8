#pragma once

#include <filesystem>

#include "core/load/scene_source.h"

namespace hybridrt {

/// Whether SCENE names a scene JSON.
bool is_scene_file(const std::filesystem::path& path);

/// Reads a scene JSON, but no mesh; `path` becomes the argument. Mesh paths are resolved against the JSON's folder.
/// Throws Error (input), naming file and place, as read_json_file does, and for unknown keys, values of the wrong kind,
/// no mesh, too many lights, lights that are not directional, and both a camera and a camera path.
SceneSource read_scene_file(const std::filesystem::path& path);

/// The camera of such a source ("camera", or "camera_path" as an object or the name of a file beside it), if it has
/// one. Separate from the rest because it depends on the up axis, which the command line may change.
/// The file that the scene JSON names as its camera path; empty if there is none.
std::filesystem::path camera_file_of(const SceneSource& source);

std::optional<CameraCourse> scene_file_camera(const SceneSource& source, UpAxis up, Warnings& warnings);

/// A JSON object of render options by their names without dashes, as `settings` of a scene JSON. Throws Error(input).
std::vector<std::pair<std::string, std::string>> read_settings_file(const std::filesystem::path& path);

}  // namespace hybridrt
