#pragma once

#include "core/render/frame_spec.h"
#include "core/scene/camera_path.h"

namespace hybridrt {

/// Where the camera is at each frame: still, on an orbit once around over `sequence`, or on a path with
/// frame numbers of its own.
struct CameraMotion {
  CameraCourse course = Orbit{};
  FrameRange sequence;  ///< the whole that a frame's number is relative to
};
Camera camera_at(const CameraMotion& motion, int frame);

/// What the light does while frames pass.
enum class LightMode {
  fixed,        ///< stands still in the world
  with_path,    ///< moves with the keys of a camera path that say so
  with_camera,  ///< stands still as seen from the camera: what turns is the scene (turntables)
};

struct LightMotion {
  DirectionalLight light;  ///< at the first frame of the sequence; its colour at all
  LightMode mode = LightMode::fixed;
};
DirectionalLight light_at(const LightMotion& light, const CameraMotion& camera, int frame);

/// Whether two frames of the sequence may have different lights.
bool light_moves(const LightMotion& light, const CameraMotion& camera);

}  // namespace hybridrt
