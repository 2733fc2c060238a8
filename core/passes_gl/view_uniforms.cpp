#include "core/passes_gl/view_uniforms.h"

namespace hybridrt {

FarPointUniforms::FarPointUniforms(const gl::Program& program, const std::string& name)
    : high_(program, name + "_high"), low_(program, name + "_low") {}

void FarPointUniforms::set(const dvec3& point) const {
  const vec3 high(point);
  high_.set(high);
  low_.set(vec3(point - dvec3(high)));
}

ViewUniforms::ViewUniforms(const gl::Program& program)
    : eye_(program, "eye"),
      ray_first_(program, "ray_first"),
      ray_step_x_(program, "ray_step_x"),
      ray_step_y_(program, "ray_step_y"),
      first_pixel_x_(program, "first_pixel_x"),
      first_pixel_y_(program, "first_pixel_y") {}

void ViewUniforms::set(const View& view) const {
  eye_.set(view.eye);
  ray_first_.set(vec3(view.ray_first()));
  ray_step_x_.set(vec3(view.ray_step_x()));
  ray_step_y_.set(vec3(view.ray_step_y()));
  first_pixel_x_.set(view.x_px);
  first_pixel_y_.set(view.y_px);
}

}  // namespace hybridrt
