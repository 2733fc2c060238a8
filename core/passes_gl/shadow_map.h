#pragma once

#include "core/passes/shadow_map_fit.h"
#include "core/passes_gl/scene_gpu.h"
#include "core/passes_gl/view_uniforms.h"

namespace hybridrt {

/// Pass 1 (paper, section 3.4): the depth of the nearest surface that the light sees, geometry only.
struct ShadowMapPass {
  /// `holes`: SceneGpu::has_holes().
  ShadowMapPass(const gl::Functions& gl, const gl::ShaderSources& shaders, bool holes = false);

  struct In {
    const SceneGpu& scene;
    const ShadowMapFit& fit;
    int size_px;
  };
  struct Out {
    const gl::Framebuffer&
        depth;  ///< DEPTH_COMPONENT32F, size_px square: 0.5 + 0.5 z / w of the fit, 1 where nothing is
  };
  void run(const In& in, const Out& out) const;

 private:
  const gl::Functions& gl_;
  const bool holes_;
  gl::Program program_;
  FarPointUniforms origin_{program_, "origin"};
  gl::Uniform<mat4> clip_from_origin_{program_, "clip_from_origin"};
};

}  // namespace hybridrt
