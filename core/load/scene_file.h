#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/load/camera_json.h"
#include "core/scene/camera_path.h"
#include "core/scene/scene.h"

namespace hybridrt {

/// What a scene JSON says, besides its meshes' contents. Everything that is not said is left empty: the
/// command line decides then. Numbers are in the axes of the files.
struct SceneDescription {
  std::vector<std::filesystem::path> meshes;  ///< at least one, as found from the JSON's folder
  std::optional<UpAxis> up_axis;
  std::optional<std::vector<DirectionalLight>> lights;  ///< `toward` unit, at most HRT_MAX_LIGHTS; may be none
  std::optional<vec3> ambient, background;
  /// Render options by the names of the command line, without dashes, and their values as text; "true" where
  /// a flag is set. Their names are not checked here.
  std::vector<std::pair<std::string, std::string>> settings;
};

/// Whether SCENE names a scene JSON.
bool is_scene_file(const std::filesystem::path& path);

/// Reads the description, no mesh. Throws Error (input) naming file and place: what read_json_file throws,
/// unknown keys, values of the wrong kind, no mesh, too many lights, other lights than directional ones, both
/// a camera and a camera path.
SceneDescription read_scene_file(const std::filesystem::path& path);

/// The camera of a scene JSON ("camera", or "camera_path" as an object or the name of a file beside it), if
/// it has one. Apart, since it needs to know what the command line makes of the up axis and the field of
/// view.
std::optional<CameraCourse> read_scene_file_camera(const std::filesystem::path& path, const CameraFileContext& context,
                                                   Warnings& warnings);

}  // namespace hybridrt
