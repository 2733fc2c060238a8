#include "cli/light_options.h"

#include "cli/option_values.h"

#include <algorithm>

namespace hybridrt::cli {

LightMotion make_light(const RenderOptions& o, const RenderJob& job, UpAxis up_axis,
                       const std::optional<DirectionalLight>& of_scene, Surroundings surroundings) {
  const int first = job.motion.sequence.first;
  const auto* path = std::get_if<CameraPath>(&job.motion.course);
  const std::optional<dvec3> keyed = path ? light_on_path(*path, first) : std::nullopt;
  LightMotion motion;
  motion.light = default_light(surroundings, camera_at(job.motion, first), job.settings.ambient);
  if (of_scene) motion.light.color = of_scene->color;
  if (!o.light.empty()) {
    const dvec3 toward = parse_vector("--light", o.light);
    if (toward == dvec3(0)) throw error(ErrorKind::usage, "--light {}: it must not be zero", o.light);
    const double largest = std::max({std::abs(toward.x), std::abs(toward.y), std::abs(toward.z)});
    motion.light.toward = glm::normalize(y_up_from_files(up_axis, toward / largest));  // any length: squares overflow
  } else if (keyed) {
    motion.light.toward = *keyed;
    motion.mode = LightMode::with_path;
  } else if (of_scene) {
    motion.light.toward = y_up_from_files(up_axis, of_scene->toward);
  } else if (surroundings == Surroundings::inside) {
    motion.mode = LightMode::with_camera;
  }
  if (!o.light.empty() || keyed || of_scene) motion.light.casts_shadow = true;
  if (o.light_follows.empty()) return motion;
  if (o.light_follows != "camera")
    throw error(ErrorKind::usage, "--light-follows {}: not known; one of camera", o.light_follows);
  if (motion.mode == LightMode::with_path)
    throw error(ErrorKind::usage,
                "--light-follows camera: the camera path's keys move the light already; replace it by --light X,Y,Z");
  motion.mode = LightMode::with_camera;
  return motion;
}

}  // namespace hybridrt::cli
