#pragma once

#include "core/render/frame_spec.h"
#include "core/scene/camera_path.h"

namespace hybridrt {

/// Where the camera is at each frame: still, on an orbit that `sequence` covers once, or on a path with its own frame
/// numbers.
struct CameraMotion {
  CameraCourse course = Orbit{};
  FrameRange sequence;  ///< the sequence that a frame number is relative to
};
Camera camera_at(const CameraMotion& motion, int frame);

/// What the lights do while frames pass.
enum class LightMode {
  fixed,        ///< stand still in the world
  with_path,    ///< the first moves with the keys of a camera path that say so, the others stand still
  with_camera,  ///< all stand still relative to the camera, as on a turntable
};

struct LightMotion {
  std::vector<DirectionalLight> lights;  ///< at the first frame of the sequence; colours do not change
  LightMode mode = LightMode::fixed;
};
std::vector<DirectionalLight> lights_at(const LightMotion& motion, const CameraMotion& camera, int frame);

/// Whether two frames of the sequence may have different lights.
bool lights_move(const LightMotion& motion, const CameraMotion& camera);

}  // namespace hybridrt
