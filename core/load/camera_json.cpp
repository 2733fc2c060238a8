#include "core/load/camera_json.h"

#include "core/base/error.h"
#include "core/load/json_read.h"

namespace hybridrt {
namespace {

constexpr double kLargestFrame = 1e15;  // beyond, doubles skip whole numbers; differences stay finite

double parse_fov(const JsonPlace& place) {
  const auto fov = place.find("fov_y_deg");
  if (!fov) return Camera().fov_y_rad;
  const double degrees = fov->number();
  if (!(degrees > 0 && degrees < 180))
    fov->fail(fmt::format("{:g}: must be more than 0 and less than 180 degrees", degrees));
  return degrees * kPi / 180;
}

/// Parses what keys and a still camera have in common.
Camera parse_view(const JsonPlace& place, UpAxis up_axis) {
  Camera camera;
  camera.eye_world = y_up_from_files(up_axis, place.at("eye").vector());
  camera.target_world = y_up_from_files(up_axis, place.at("target").vector());
  if (camera.eye_world == camera.target_world) place.fail("eye and target are the same point; move one of them");
  if (const auto up = place.find("up")) camera.up = glm::normalize(y_up_from_files(up_axis, up->direction()));
  camera.fov_y_rad = parse_fov(place);
  return camera;
}

CameraPath parse_keyframes(const JsonPlace& keyframes, UpAxis up_axis, Warnings& warnings) {
  CameraPath path;
  size_t useless_ups = 0;
  double first_useless = 0;
  for (size_t i = 0; i < keyframes.size(); ++i) {
    const JsonPlace place = keyframes[i];
    place.only({"frame", "eye", "target", "up", "fov_y_deg", "light"});
    CameraKey key;
    key.frame = place.at("frame").number();
    if (!(std::abs(key.frame) < kLargestFrame)) place.at("frame").fail("must be below 1e15");
    if (!path.keys.empty() && !(key.frame > path.keys.back().frame))
      place.fail(key.frame == path.keys.back().frame
                     ? fmt::format("frame {:g} is there twice; leave one key", key.frame)
                     : fmt::format("frame {:g} comes after frame {:g}; put the keys in order", key.frame,
                                   path.keys.back().frame));
    key.camera = parse_view(place, up_axis);
    if (const auto light = place.find("light"))
      key.light_toward = glm::normalize(y_up_from_files(up_axis, light->direction()));
    if (up_is_along_view(key.camera) && useless_ups++ == 0) first_useless = key.frame;
    path.keys.push_back(key);
  }
  if (path.keys.empty()) keyframes.fail("there are no keys; give at least one");
  if (useless_ups > 0)
    warnings.emplace_back(
        WarningCode::up_along_view,
        fmt::format("{}: {} keys look along their up direction (first: frame {:g}); another up is used",
                    keyframes.where(), useless_ups, first_useless));
  return path;
}

Orbit parse_orbit(const JsonPlace& place, UpAxis up_axis) {
  place.only({"target", "radius", "height", "from_deg", "to_deg", "fov_y_deg"});
  Orbit orbit;
  orbit.target_world = y_up_from_files(up_axis, place.at("target").vector());
  const JsonPlace radius = place.at("radius");
  orbit.radius = radius.number();
  if (!(orbit.radius > 0 && orbit.radius < 1e30)) radius.fail("must be more than 0 (and below 1e30)");
  if (const auto height = place.find("height")) {
    orbit.height = height->number();
    if (std::abs(orbit.height) >= 1e30) height->fail("must be below 1e30");
  }
  if (const auto from = place.find("from_deg")) orbit.from_rad = from->number() * kPi / 180;
  orbit.to_rad = place.has("to_deg") ? place.at("to_deg").number() * kPi / 180 : orbit.from_rad + 2 * kPi;
  orbit.fov_y_rad = parse_fov(place);
  return orbit;
}

}  // namespace

Camera parse_camera(const JsonPlace& place, UpAxis up_axis, Warnings& warnings) {
  place.only({"eye", "target", "up", "fov_y_deg"});
  const Camera camera = parse_view(place, up_axis);
  if (up_is_along_view(camera))
    warnings.emplace_back(WarningCode::up_along_view,
                          place.where() + ": the camera looks along its up direction; another up is used");
  return camera;
}

CameraCourse parse_camera_course(const JsonPlace& place, UpAxis up_axis, Warnings& warnings) {
  place.only({"keyframes", "orbit"});
  if (place.has("keyframes") == place.has("orbit")) place.fail("give either 'keyframes' or 'orbit'");
  if (place.has("orbit")) return parse_orbit(place.at("orbit"), up_axis);
  return parse_keyframes(place.at("keyframes"), up_axis, warnings);
}

CameraCourse read_camera_file(const std::filesystem::path& path, UpAxis up_axis, Warnings& warnings) {
  const nlohmann::json document = read_json_file(path);
  return parse_camera_course(JsonPlace(document, path.string()), up_axis, warnings);
}

}  // namespace hybridrt
