#include "cli/camera_options.h"

#include "cli/option_values.h"
#include "core/load/scene_file.h"
#include "core/procedural/procedural.h"

namespace hybridrt::cli {
namespace {

constexpr double kDefaultFov_deg = 45;

double fov_y_rad(const RenderOptions& o) {
  const double degrees = o.fov_deg.value_or(kDefaultFov_deg);
  if (!(degrees > 0 && degrees < 180))
    throw error(ErrorKind::usage, "--fov {}: allowed is more than 0 and less than 180 degrees", degrees);
  return degrees * kPi / 180;
}

/// --eye, --target, --up; `middle` is what to look at when nothing is said.
Camera still_camera(const RenderOptions& o, UpAxis up_axis, const dvec3& middle, Warnings& warnings) {
  Camera still;
  still.eye_world = y_up_from_files(up_axis, parse_vector("--eye", o.eye));
  still.target_world = o.target.empty() ? middle : y_up_from_files(up_axis, parse_vector("--target", o.target));
  if (!o.up.empty()) still.up = y_up_from_files(up_axis, parse_vector("--up", o.up));
  if (still.eye_world == still.target_world)
    throw error(ErrorKind::usage, "--eye and --target are the same point; move one of them");
  if (still.up == dvec3(0)) throw error(ErrorKind::usage, "--up {}: it must not be zero", o.up);
  if (up_is_along_view(still)) warnings.push_back("the camera looks along its up direction; another up is used");
  return still;
}

void set_fov(CameraCourse& course, double fov) {
  if (auto* still = std::get_if<Camera>(&course)) still->fov_y_rad = fov;
  if (auto* orbit = std::get_if<Orbit>(&course)) orbit->fov_y_rad = fov;
  if (auto* path = std::get_if<CameraPath>(&course))
    for (CameraKey& key : path->keys) key.camera.fov_y_rad = fov;
}

}  // namespace

CameraCourse make_course(const RenderOptions& o, RenderJob& job, UpAxis up_axis, Surroundings& surroundings,
                         ThreadPool& pool, Warnings& warnings) {
  const double fov = fov_y_rad(o);
  std::optional<CameraCourse> of_scene;
  if (o.camera.empty() && o.eye.empty() && is_scene_file(o.scene))
    of_scene = read_scene_file_camera(o.scene, {up_axis, fov}, warnings);
  if (o.eye.empty() && !(o.target.empty() && o.up.empty()))
    throw error(ErrorKind::usage, "--target and --up describe a still camera; give --eye X,Y,Z too");
  if (!o.camera.empty() && !o.eye.empty())
    throw error(ErrorKind::usage, "--camera and --eye both say where the camera is; give one of them");
  CameraCourse course;
  if (!o.camera.empty()) {
    course = read_camera_file(o.camera, {up_axis, fov}, warnings);
  } else if (of_scene) {
    course = *of_scene;
  } else {
    const double aspect = static_cast<double>(job.settings.width_px) / job.settings.height_px;
    const SceneShot shot = shot_of(o.scene);
    if (o.eye.empty() && shot.camera) {
      course = orbit_through(*shot.camera);
      if (o.fov_deg) set_fov(course, fov);
      return course;
    }
    if (o.eye.empty()) {
      job.caster = make_scene_caster(job.scene, job.accel, pool);
      const DefaultView view = choose_default_view(job.scene, *job.caster.caster, aspect, fov);
      surroundings = view.surroundings;
      course = view.orbit;
    } else {
      course = still_camera(o, up_axis, default_orbit(job.scene, aspect, fov).target_world, warnings);
    }
  }
  if (o.fov_deg || !o.eye.empty()) set_fov(course, fov);
  return course;
}

}  // namespace hybridrt::cli
