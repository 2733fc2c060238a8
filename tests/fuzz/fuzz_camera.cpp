// Camera path JSON and views along it: each is refused, or finite and orthonormal.

#include <stdexcept>

#include "core/load/camera_json.h"
#include "core/scene/view.h"
#include "tests/fuzz/input_file.h"
#include "tests/fuzz/reader.h"

namespace hybridrt::fuzz {
namespace {

void require(bool promise, const char* what) {
  if (!promise) throw std::logic_error(what);
}

bool is_unit(const dvec3& v) { return std::abs(glm::dot(v, v) - 1) < 1e-9; }

void look_through(const Camera& camera) {
  const View view = make_view(camera, dvec3(0), 64, 48);
  for (int axis = 0; axis < 3; ++axis) require(std::isfinite(view.eye[axis]), "the eye is nowhere");
  require(is_unit(view.right) && is_unit(view.up) && is_unit(view.forward), "an axis is not unit");
  require(std::abs(glm::dot(view.right, view.up)) < 1e-9 && std::abs(glm::dot(view.up, view.forward)) < 1e-9,
          "axes are not at right angles");
  require(view.tan_half_height > 0 && std::isfinite(view.tan_half_width), "no field of view");
}

void follow(const CameraPath& path) {
  const double first = path.keys.front().frame, last = path.keys.back().frame;
  for (double share : {-0.1, 0.0, 0.3, 0.5, 1.0, 1.1}) {
    const double frame = first + share * (last - first);
    if (const auto light = light_on_path(path, frame)) require(is_unit(*light), "the light's direction is not unit");
    look_through(camera_on_path(path, frame));
  }
}

}  // namespace

void read_input(std::string_view bytes) {
  Warnings warnings;
  const CameraCourse course = read_camera_file(input_file("camera.json", bytes), UpAxis::z, warnings);
  if (const auto* still = std::get_if<Camera>(&course)) look_through(*still);
  if (const auto* path = std::get_if<CameraPath>(&course)) follow(*path);
  if (const auto* orbit = std::get_if<Orbit>(&course))
    for (double share : {0.0, 0.25, 0.6}) look_through(camera_on_orbit(*orbit, share));
}

}  // namespace hybridrt::fuzz
