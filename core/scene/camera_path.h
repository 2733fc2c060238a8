#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "core/base/warnings.h"
#include "core/scene/camera.h"
#include "core/scene/up_axis.h"

namespace hybridrt {

class JsonPlace;

/// The camera at one frame, and perhaps the light.
struct CameraKey {
  double frame = 1;
  Camera camera;
  std::optional<dvec3> light_toward;  ///< unit
};

/// A camera that moves from key to key, held before the first and after the last.
struct CameraPath {
  std::vector<CameraKey> keys;  ///< at least one; frames strictly ascending
};

/// Between keys, eye and target each go along a centripetal Catmull-Rom curve (no loops or cusps, however
/// uneven the keys; Yuksel, Schaefer, Keyser: Parameterization and applications of Catmull-Rom curves, 2011),
/// covering a segment's parameter evenly in time; `up` goes the same way and is made unit; the field of view
/// never leaves the range of the two keys around it (Fritsch and Butland, 1984).
Camera camera_on_path(const CameraPath& path, double frame);

/// Unit, toward the light, along the keys that have one; nothing if none has.
std::optional<dvec3> light_on_path(const CameraPath& path, double frame);

/// What a camera file can say.
using CameraCourse = std::variant<Camera, Orbit, CameraPath>;

/// Settings that the numbers of a camera file are read by.
struct CameraFileContext {
  UpAxis up = UpAxis::y;               ///< the numbers are in the axes of the scene's files
  double default_fov_y_rad = kPi / 4;  ///< where none is given
};

/// {"keyframes": [{"frame", "eye", "target", "up", "fov_y_deg", "light"}, …]} or
/// {"orbit": {"target", "radius", "height", "from_deg", "to_deg", "fov_y_deg"}}: the documentation's camera
/// path. Throws Error (input) naming file and place: what read_json_file throws, unknown or missing keys,
/// numbers that are none or not finite, eye = target, a field of view outside of 0-180, frames not ascending,
/// no keys. An `up` along the view is counted in one warning; the view takes another one (make_view).
CameraCourse read_camera_file(const std::filesystem::path& path, const CameraFileContext& context,
                              Warnings& warnings);

/// The same from a value inside another file.
CameraCourse parse_camera_course(const JsonPlace& place, const CameraFileContext& context,
                                 Warnings& warnings);

/// {"eye", "target", "up", "fov_y_deg"}: a still camera.
Camera parse_camera(const JsonPlace& place, const CameraFileContext& context, Warnings& warnings);

}  // namespace hybridrt
