#include "cli/light_options.h"

#include <algorithm>

#include "cli/option_values.h"

namespace hybridrt::cli {

size_t light_count(const RenderOptions& o, const std::optional<std::vector<DirectionalLight>>& of_scene) {
  return o.light.empty() && of_scene ? of_scene->size() : 1;
}

LightMotion make_lights(const RenderOptions& o, const RenderJob& job, UpAxis up_axis,
                        const std::optional<std::vector<DirectionalLight>>& of_scene, Surroundings surroundings,
                        Warnings& warnings) {
  const int first = job.motion.sequence.first;
  const auto* path = std::get_if<CameraPath>(&job.motion.course);
  const std::optional<dvec3> keyed = path ? light_on_path(*path, first) : std::nullopt;
  LightMotion motion;
  if (o.light.empty() && of_scene) {
    motion.lights = *of_scene;
    for (DirectionalLight& light : motion.lights) light.toward = y_up_from_files(up_axis, light.toward);
  } else {
    motion.lights = {default_light(surroundings, camera_at(job.motion, first), job.settings.ambient)};
    if (of_scene && !of_scene->empty()) motion.lights[0].color = of_scene->front().color;
    if (!o.light.empty() || keyed) motion.lights[0].casts_shadow = true;
  }
  if (!o.light.empty()) {
    const dvec3 toward = parse_vector("--light", o.light);
    if (toward == dvec3(0)) throw error(ErrorKind::usage, "--light {}: it must not be zero", o.light);
    const double largest = std::max({std::abs(toward.x), std::abs(toward.y), std::abs(toward.z)});
    // Any length: squares overflow.
    motion.lights[0].toward = glm::normalize(y_up_from_files(up_axis, toward / largest));
  } else if (keyed && motion.lights.empty()) {
    warnings.push_back("the camera path's keys move the first light, but the scene's list of lights is empty");
  } else if (keyed) {
    motion.lights[0].toward = *keyed;
    motion.mode = LightMode::with_path;
  } else if (!of_scene && surroundings == Surroundings::inside) {
    motion.mode = LightMode::with_camera;
  }
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
