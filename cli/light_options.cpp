#include "cli/light_options.h"

#include <algorithm>
#include <optional>

#include "core/base/error.h"

namespace hybridrt::cli {
namespace {

/// `v` as a unit vector; divides first, so that squares do not overflow.
dvec3 unit(const dvec3& v) { return glm::normalize(v / std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)})); }

/// The lights before the camera's motion moves any of them.
std::vector<DirectionalLight> still_lights(const RenderOptions& o, const SceneSource& source, const Camera& first,
                                           const AmbientLight& ambient, UpAxis up_axis, Surroundings surroundings) {
  if (!o.light && source.lights) {
    std::vector<DirectionalLight> lights = *source.lights;
    for (DirectionalLight& light : lights) light.toward = y_up_from_files(up_axis, light.toward);
    return lights;
  }
  DirectionalLight light = default_light(surroundings, first, ambient);
  if (o.light) {
    light.casts_shadow = true;
    light.toward = unit(y_up_from_files(up_axis, *o.light));
    light.color = color_beside(ambient, light.toward);
    if (source.lights && !source.lights->empty()) light.color = source.lights->front().color;
  }
  return {light};
}

}  // namespace

AmbientLight choose_ambient(const RenderOptions& o, const SceneSource& source, const CameraMotion& camera,
                            Surroundings surroundings) {
  if (source.ambient) return *source.ambient;
  const int first = camera.sequence.first;
  const auto* path = std::get_if<CameraPath>(&camera.course);
  const bool light_of_ones_own = o.light || source.lights || (path && light_on_path(*path, first));
  if (light_of_ones_own || o.light_follows_camera) return {};
  return default_ambient(surroundings, default_light(surroundings, camera_at(camera, first), {}).toward);
}

size_t light_count(const RenderOptions& o, const SceneSource& source) {
  return !o.light && source.lights ? source.lights->size() : 1;
}

LightMotion choose_lights(const RenderOptions& o, const SceneSource& source, const CameraMotion& camera,
                          const AmbientLight& ambient, UpAxis up_axis, Surroundings surroundings, Warnings& warnings) {
  const int first = camera.sequence.first;
  const auto* path = std::get_if<CameraPath>(&camera.course);
  const std::optional<dvec3> keyed = path && !o.light ? light_on_path(*path, first) : std::nullopt;
  LightMotion motion;
  motion.lights = still_lights(o, source, camera_at(camera, first), ambient, up_axis, surroundings);
  if (keyed && motion.lights.empty()) {
    warnings.emplace_back(WarningCode::light_missing,
                          "the camera path's keys move the first light, but the scene's list of lights is empty");
  } else if (keyed) {
    motion.lights[0].toward = *keyed;
    if (!source.lights) motion.lights[0].casts_shadow = true;
    motion.mode = LightMode::with_path;
  } else if (!o.light && !source.lights && surroundings == Surroundings::inside) {
    motion.mode = LightMode::with_camera;
  }
  if (!o.light_follows_camera) return motion;
  if (motion.mode == LightMode::with_path)
    throw error(ErrorKind::usage,
                "--light-follows camera: the camera path's keys move the light already; replace it by --light X,Y,Z");
  motion.mode = LightMode::with_camera;
  return motion;
}

}  // namespace hybridrt::cli
