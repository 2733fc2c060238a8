#pragma once

#include <filesystem>

#include "core/base/warnings.h"
#include "core/scene/camera_path.h"
#include "core/scene/up_axis.h"

namespace hybridrt {

class JsonPlace;

// The numbers are in the axes of the scene's files, of which `up_axis` points up.

/// {"keyframes": [{"frame", "eye", "target", "up", "fov_y_deg", "light"}, …]} or {"orbit": {"target", "radius",
/// "height", "from_deg", "to_deg", "fov_y_deg"}}: the documentation's camera path. Throws Error (input), naming file
/// and place, as read_json_file does, and for unknown or missing keys, values that are not finite numbers, eye =
/// target, a field of view outside 0-180, frames that do not ascend, and no keys. Cases of `up` along the view are
/// counted in one warning; make_view replaces it.
CameraCourse read_camera_file(const std::filesystem::path& path, UpAxis up_axis, Warnings& warnings);

/// The same from a value inside another file.
CameraCourse parse_camera_course(const JsonPlace& place, UpAxis up_axis, Warnings& warnings);

/// {"eye", "target", "up", "fov_y_deg"}: a still camera.
Camera parse_camera(const JsonPlace& place, UpAxis up_axis, Warnings& warnings);

}  // namespace hybridrt
