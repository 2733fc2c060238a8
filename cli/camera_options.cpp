#include "cli/camera_options.h"

#include <algorithm>
#include <fmt/format.h>

#include "core/base/error.h"
#include "core/load/camera_json.h"
#include "core/render/room.h"

namespace hybridrt::cli {
namespace {

/// The camera of --eye, --target and --up; `middle` is the default target.
Camera still_camera(const RenderOptions& o, UpAxis up_axis, const dvec3& middle, Warnings& warnings) {
  Camera still;
  still.eye_world = y_up_from_files(up_axis, *o.eye);
  still.target_world = o.target ? y_up_from_files(up_axis, *o.target) : middle;
  if (o.up) still.up = y_up_from_files(up_axis, *o.up);
  if (still.eye_world == still.target_world)
    throw error(ErrorKind::usage, "--eye and --target are the same point; move one of them");
  if (up_is_along_view(still))
    warnings.emplace_back(WarningCode::up_along_view, "the camera looks along its up direction; another up is used");
  return still;
}

void set_fov(CameraCourse& course, double fov_y_rad) {
  if (auto* still = std::get_if<Camera>(&course)) still->fov_y_rad = fov_y_rad;
  if (auto* orbit = std::get_if<Orbit>(&course)) orbit->fov_y_rad = fov_y_rad;
  if (auto* path = std::get_if<CameraPath>(&course))
    for (CameraKey& key : path->keys) key.camera.fov_y_rad = fov_y_rad;
}

void require_one_camera(const RenderOptions& o) {
  if (!o.eye && (o.target || o.up))
    throw error(ErrorKind::usage, "--target and --up describe a still camera; give --eye X,Y,Z too");
  if (!o.camera.empty() && o.eye)
    throw error(ErrorKind::usage, "--camera and --eye both say where the camera is; give one of them");
}

void warn_of_stray(const Scene& scene, const Framing& framing, Warnings& warnings) {
  if (framing.left_out == 0) return;
  const dvec3 p = scene.origin_world + dvec3(framing.an_outlier);
  warnings.emplace_back(
      WarningCode::triangles_astray,
      fmt::format(
          "{} triangles lie far from all others (one at {:g}, {:g}, {:g}); the default camera does not frame them",
          framing.left_out, p.x, p.y, p.z));
}

/// A scene that lies flat across z was probably made where z points up.
void hint_at_up_axis(const RenderOptions& o, const SceneSource& source, const Aabb& framed, Warnings& warnings) {
  constexpr float kThin = 0.25f;
  if (o.up_axis || source.up_axis) return;
  const vec3 size = framed.extent();
  if (size.z > 0 && size.z < kThin * std::min(size.x, size.y))
    warnings.emplace_back(WarningCode::up_axis_doubtful,
                          "the scene lies flat across its z axis; if z points up, say --up-axis z (else --up-axis y)");
}

bool gives_lights(const RenderOptions& o, const SceneSource& source, const CameraCourse& course) {
  const auto* path = std::get_if<CameraPath>(&course);
  return o.light || source.lights || (path && light_on_path(*path, path->keys.front().frame));
}

/// The camera named by an option or by the scene, if any.
std::optional<CameraCourse> named_course(const RenderOptions& o, const SceneSource& source, const RenderJob& job,
                                         const Aabb& framed, UpAxis up_axis, double aspect, double fov_y_rad,
                                         Warnings& warnings) {
  if (!o.camera.empty()) return read_camera_file(o.camera, up_axis, warnings);
  if (!o.eye) return camera_of(source, up_axis, warnings);
  Camera still = still_camera(o, up_axis, default_orbit(job.scene, framed, aspect, fov_y_rad).target_world, warnings);
  return still;
}

/// The job's caster, or a new one.
SceneCaster<float> caster_of(const RenderJob& job, ThreadPool& pool) {
  return job.caster.caster ? job.caster : make_scene_caster(job.scene, job.settings.accel, pool);
}

/// What a camera of the user's stands in: a closed room, where it carries the default light, or a solid.
void look_at_surroundings(const RenderOptions& o, const SceneSource& source, const RenderJob& job, const Aabb& framed,
                          ThreadPool& pool, ChosenCamera& chosen, Warnings& warnings) {
  const Camera first = camera_at({chosen.course, job.motion.sequence}, job.motion.sequence.first);
  const vec3 eye(first.eye_world - job.scene.origin_world);
  if (!framed.holds(eye)) return;
  chosen.caster = caster_of(job, pool);
  const World world{job.scene, job.topology, framed, *chosen.caster.caster};
  if (is_in_solid(world, eye))
    warnings.emplace_back(WarningCode::camera_in_body,
                          "the camera is inside a solid body, whose inside is all it sees; check --eye and --up-axis");
  else if (!gives_lights(o, source, chosen.course) && is_in_closed_room(world, eye))
    chosen.surroundings = Surroundings::inside;
}

}  // namespace

ChosenCamera choose_camera(const RenderOptions& o, const SceneSource& source, const RenderJob& job,
                           const Framing& framing, UpAxis up_axis, ThreadPool& pool, Warnings& warnings) {
  require_one_camera(o);
  const double fov_y_rad = o.fov_y_rad.value_or(Camera().fov_y_rad);
  const double aspect = static_cast<double>(job.settings.width_px) / job.settings.height_px;
  ChosenCamera chosen;
  if (auto named = named_course(o, source, job, framing.bounds, up_axis, aspect, fov_y_rad, warnings)) {
    chosen.course = std::move(*named);
    look_at_surroundings(o, source, job, framing.bounds, pool, chosen, warnings);
  } else {
    chosen.caster = caster_of(job, pool);
    hint_at_up_axis(o, source, framing.bounds, warnings);
    warn_of_stray(job.scene, framing, warnings);
    const DefaultView view =
        choose_default_view({job.scene, job.topology, framing.bounds, *chosen.caster.caster}, aspect, fov_y_rad);
    if (view.surroundings == Surroundings::inside)
      warnings.emplace_back(
          WarningCode::camera_in_room,
          "the scene looks like a room, and the camera stands in it; --eye and --target place it elsewhere");
    chosen.surroundings = view.surroundings;
    chosen.course = view.orbit;
  }
  if (o.fov_y_rad) set_fov(chosen.course, fov_y_rad);
  return chosen;
}

}  // namespace hybridrt::cli
