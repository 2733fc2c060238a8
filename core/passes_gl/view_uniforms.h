#pragma once

#include <string>

#include "core/gl/uniform.h"
#include "core/scene/view.h"

namespace hybridrt {

/// A point as the sum of two floats, `name`_high and `name`_low in a shader: subtracting them one after the other keeps
/// the precision of what is near the point.
class FarPointUniforms {
 public:
  FarPointUniforms(const gl::Program& program, const std::string& name);
  void set(const dvec3& point) const;

 private:
  gl::Uniform<vec3> high_, low_;
};

/// The uniforms of shaders/scene.glsl that come from the camera.
class ViewUniforms {
 public:
  explicit ViewUniforms(const gl::Program& program);
  void set(const View& view) const;

 private:
  FarPointUniforms eye_;
  gl::Uniform<vec3> ray_first_, ray_step_x_, ray_step_y_;
  gl::Uniform<int> first_pixel_x_, first_pixel_y_;
};

}  // namespace hybridrt
