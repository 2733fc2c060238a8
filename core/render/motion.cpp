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
  return camera_on_orbit(std::get<Orbit>(motion.course), (static_cast<double>(frame) - motion.sequence.first) / length);
}

std::vector<DirectionalLight> lights_at(const LightMotion& motion, const CameraMotion& camera, int frame) {
  std::vector<DirectionalLight> now = motion.lights;
  if (now.empty()) return now;
  if (motion.mode == LightMode::with_path) {
    if (const auto* path = std::get_if<CameraPath>(&camera.course))
      now[0].toward = light_on_path(*path, frame).value_or(now[0].toward);
  } else if (motion.mode == LightMode::with_camera && frame != camera.sequence.first) {
    const glm::dmat3 camera_from_world = glm::transpose(world_from_camera(camera_at(camera, camera.sequence.first)));
    for (DirectionalLight& light : now) {
      const dvec3 seen = camera_from_world * light.toward;
      light.toward = glm::normalize(world_from_camera(camera_at(camera, frame)) * seen);
    }
  }
  return now;
}

bool lights_move(const LightMotion& motion, const CameraMotion& camera) {
  if (motion.lights.empty() || camera.sequence.first == camera.sequence.last) return false;
  if (motion.mode == LightMode::with_camera) return !std::holds_alternative<Camera>(camera.course);
  const auto* path = std::get_if<CameraPath>(&camera.course);
  return motion.mode == LightMode::with_path && path && light_on_path(*path, camera.sequence.first).has_value();
}

}  // namespace hybridrt
