#pragma once

#include <optional>
#include <variant>
#include <vector>

#include "core/scene/camera.h"

namespace hybridrt {

/// The camera at one frame, and perhaps the light.
struct CameraKey {
  double frame = 1;
  Camera camera;
  std::optional<dvec3> light_toward;  ///< unit
};

/// A camera that moves from key to key and stands still before the first and after the last.
struct CameraPath {
  std::vector<CameraKey> keys;  ///< at least one; frames strictly ascending
};

/// Between keys, eye and target each go along a centripetal Catmull-Rom curve (no loops or cusps, however uneven the
/// keys; Yuksel, Schaefer, Keyser: Parameterization and applications of Catmull-Rom curves, 2011), with a segment's
/// parameter even in time; `up` follows the same kind of curve and is normalised; the field of view never leaves the
/// range of the two keys around it (Fritsch and Butland, 1984).
Camera camera_on_path(const CameraPath& path, double frame);

/// The unit direction toward the light, along the keys that have one; nothing if none has.
std::optional<dvec3> light_on_path(const CameraPath& path, double frame);

/// What a camera file can describe.
using CameraCourse = std::variant<Camera, Orbit, CameraPath>;

}  // namespace hybridrt
