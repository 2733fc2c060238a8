#include "core/render/motion.h"

#include "core/scene/view.h"

namespace hybridrt {
namespace {

/// Columns: right, up and backward of a camera.
glm::dmat3 world_from_camera(const Camera& camera) {
  const View view = make_view(camera, dvec3(0), 1, 1);
  return {view.right, view.up, -view.forward};
}

}  // namespace

Camera camera_at(const CameraMotion& motion, int frame) {
  if (const auto* still = std::get_if<Camera>(&motion.course)) return *still;
  if (const auto* path = std::get_if<CameraPath>(&motion.course)) return camera_on_path(*path, frame);
  const double length = static_cast<double>(motion.sequence.last) - motion.sequence.first + 1;
  return camera_on_orbit(std::get<Orbit>(motion.course),
                         (static_cast<double>(frame) - motion.sequence.first) / length);
}

DirectionalLight light_at(const LightMotion& light, const CameraMotion& camera, int frame) {
  DirectionalLight now = light.light;
  if (light.mode == LightMode::with_path) {
    if (const auto* path = std::get_if<CameraPath>(&camera.course))
      now.toward = light_on_path(*path, frame).value_or(now.toward);
  } else if (light.mode == LightMode::with_camera && frame != camera.sequence.first) {
    const dvec3 seen =
        glm::transpose(world_from_camera(camera_at(camera, camera.sequence.first))) * now.toward;
    now.toward = glm::normalize(world_from_camera(camera_at(camera, frame)) * seen);
  }
  return now;
}

bool light_moves(const LightMotion& light, const CameraMotion& camera) {
  if (camera.sequence.first == camera.sequence.last) return false;
  if (light.mode == LightMode::with_camera) return !std::holds_alternative<Camera>(camera.course);
  const auto* path = std::get_if<CameraPath>(&camera.course);
  return light.mode == LightMode::with_path && path && light_on_path(*path, camera.sequence.first).has_value();
}

}  // namespace hybridrt
