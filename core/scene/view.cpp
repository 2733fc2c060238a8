#include "core/scene/view.h"

#include "core/base/error.h"

namespace hybridrt {
namespace {

dvec3 perpendicular_part(const dvec3& v, const dvec3& unit_axis) { return v - glm::dot(v, unit_axis) * unit_axis; }

}  // namespace

View make_view(const Camera& camera, const dvec3& scene_origin_world, int width_px, int height_px) {
  View view;
  view.width_px = view.frame_width_px = width_px;
  view.height_px = view.frame_height_px = height_px;
  view.eye = camera.eye_world - scene_origin_world;

  const dvec3 gaze = camera.target_world - camera.eye_world;
  const double distance = glm::length(gaze);
  if (!(distance > 0) || !std::isfinite(distance))
    throw Error(ErrorKind::input, "the camera's eye and target are the same point; move one of them");
  view.forward = gaze / distance;

  dvec3 up = perpendicular_part(camera.up, view.forward);
  if (up_is_along_view(camera))
    up = perpendicular_part(std::abs(view.forward.y) < 0.9 ? dvec3(0, 1, 0) : dvec3(0, 0, -1), view.forward);
  view.up = glm::normalize(up);
  view.right = glm::cross(view.forward, view.up);

  view.tan_half_height = std::tan(0.5 * camera.fov_y_rad);
  view.tan_half_width = view.tan_half_height * width_px / height_px;
  return view;
}

View part_of(const View& frame, int x_px, int y_px, int width_px, int height_px) {
  View view = frame;
  view.x_px = frame.x_px + x_px;
  view.y_px = frame.y_px + y_px;
  view.width_px = width_px;
  view.height_px = height_px;
  return view;
}

View at_centres(const View& view) {
  View centred = view;
  centred.sample_px = dvec2(0);
  return centred;
}

View whole_frame_of(const View& part) {
  return part_of(part, -part.x_px, -part.y_px, part.frame_width_px, part.frame_height_px);
}

dmat4 clip_from_eye(const View& view, double near_distance) {
  const dvec3& w = view.forward;
  // Moves what the sample sees to the pixel's centre, where the raster looks.
  const dvec3 x = view.right / view.tan_half_width - 2 * view.sample_px.x / view.frame_width_px * w;
  const dvec3 y = view.up / view.tan_half_height + 2 * view.sample_px.y / view.frame_height_px * w;
  return glm::transpose(dmat4(dvec4(x, 0), dvec4(y, 0), dvec4(0, 0, 0, near_distance), dvec4(w, 0)));
}

}  // namespace hybridrt
