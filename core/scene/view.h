#pragma once

#include "core/base/math.h"
#include "core/scene/camera.h"

namespace hybridrt {

/// A camera and a picture's size, ready for rays and matrices. Scene space, double precision; everything
/// that works in float subtracts the eye first.
struct View {
  int width_px = 0, height_px = 0;              ///< size of the picture: the whole frame, or a part of it
  int x_px = 0, y_px = 0;                       ///< its first pixel in the frame
  int frame_width_px = 0, frame_height_px = 0;  ///< size of the whole frame
  dvec3 eye{0};
  dvec3 right{1, 0, 0}, up{0, 1, 0}, forward{0, 0, -1};  ///< orthonormal
  double tan_half_width = 1, tan_half_height = 1;        ///< from the frame's middle to its edges
  dvec2 sample_px{0};                                    ///< the sample's place in the pixel, from its centre
  int samples = 1;                                       ///< samples per pixel: each stands for a part of its area

  bool operator==(const View&) const = default;

  /// Direction through the sample (by default the centre) of pixel (x, y) of the picture, row 0 on top; its component
  /// along `forward` is 1. Equal to the bit for a part of a frame and for the whole.
  dvec3 pixel_dir(int x, int y) const {
    return ray_first() + static_cast<double>(x_px + x) * ray_step_x() + static_cast<double>(y_px + y) * ray_step_y();
  }
  /// The solid angle that a sample of pixel (x, y) stands for: textures are filtered over it.
  double sample_solid_angle(int x, int y) const {
    const dvec3 dir = pixel_dir(x, y);
    const double squared = glm::dot(dir, dir);
    return sample_area() / (squared * std::sqrt(squared));
  }
  /// The area of a sample's part of a pixel, on the plane where the component along `forward` is 1.
  double sample_area() const { return glm::length(glm::cross(ray_step_x(), ray_step_y())) / samples; }
  /// The direction through the frame's first pixel, and the steps to its neighbours.
  dvec3 ray_first() const {
    return forward - tan_half_width * right + tan_half_height * up + (0.5 + sample_px.x) * ray_step_x() +
           (0.5 + sample_px.y) * ray_step_y();
  }
  dvec3 ray_step_x() const { return 2 * tan_half_width / frame_width_px * right; }
  dvec3 ray_step_y() const { return -2 * tan_half_height / frame_height_px * up; }
};

/// Throws Error(input) when eye and target coincide. An `up` along the view is replaced by another one.
View make_view(const Camera& camera, const dvec3& scene_origin_world, int width_px, int height_px);

/// The part of a whole frame's view, `width_px` by `height_px` pixels, that begins at (x_px, y_px).
View part_of(const View& frame, int x_px, int y_px, int width_px, int height_px);

/// `view` with its samples in the pixels' centres.
View at_centres(const View& view);

/// The view of the whole frame that `part` belongs to.
View whole_frame_of(const View& part);

/// Perspective projection of positions relative to the eye, of the whole frame. Depth is reversed and reaches infinity
/// (depth = near / distance): with float depth every distance keeps the same relative precision.
/// For glClipControl(GL_UPPER_LEFT, GL_ZERO_TO_ONE).
dmat4 clip_from_eye(const View& view, double near_distance);

}  // namespace hybridrt
