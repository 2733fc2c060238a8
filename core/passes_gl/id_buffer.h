#pragma once

#include "core/passes/shadow_map_fit.h"
#include "core/passes_gl/scene_gpu.h"
#include "core/passes_gl/view_uniforms.h"

namespace hybridrt {

/// Pass 2, first step (paper, section 3.4): the number of the triangle that each pixel sees.
struct IdBufferPass {
  /// `holes`: SceneGpu::has_holes().
  IdBufferPass(const gl::Functions& gl, const gl::ShaderSources& shaders, bool holes = false);

  struct In {
    const SceneGpu& scene;
    const View& view;
    double near_distance;
  };
  struct Out {
    const gl::Framebuffer& ids;  ///< R32UI and DEPTH_COMPONENT32F, as large as the view, row 0 on top
  };
  void run(const In& in, const Out& out) const;

 private:
  const gl::Functions& gl_;
  const bool holes_;
  gl::Program program_;
  FarPointUniforms eye_{program_, "eye"};
  gl::Uniform<mat4> clip_from_eye_{program_, "clip_from_eye"};
};

/// Pass 2, second step: the shadow-map test, once per pixel that sees a triangle.
struct ShadowTestPass {
  ShadowTestPass(const gl::Functions& gl, const gl::ShaderSources& shaders);

  struct In {
    const SceneGpu& scene;
    const View& view;
    const dvec3& to_light;    ///< unit
    const ShadowMapFit& fit;  ///< with which `shadow_map` was drawn
    const gl::Texture& ids;
    const gl::Texture& shadow_map;
  };
  struct Out {
    const gl::TextureName& mask;  ///< R8UI, HRT_MASK_* bits (shaders/shared.h)
    int layer = 0;                ///< the layer of `mask` that is written
  };
  void run(const In& in, const Out& out) const;

 private:
  const gl::Functions& gl_;
  gl::Program program_;
  ViewUniforms view_{program_};
  gl::Uniform<vec3> to_light_{program_, "to_light"};
  gl::Uniform<mat4> map_from_eye_{program_, "map_from_eye"};
  // As in ShadowMapFit.
  gl::Uniform<vec3> across_{program_, "fit.across"}, along_{program_, "fit.along"};
  gl::Uniform<float> inverse_w_slope_{program_, "fit.inverse_w_slope"};
  gl::Uniform<float> texel_across_{program_, "fit.texel_across"}, texel_along_{program_, "fit.texel_along"};
  gl::Uniform<float> uniform_texel_{program_, "fit.uniform_texel"}, misplacement_{program_, "fit.misplacement"};
  gl::Uniform<float> lean_first_{program_, "fit.lean_first"}, lean_step_{program_, "fit.lean_step"};
  gl::Uniform<int> warped_{program_, "fit.warped"};
};

}  // namespace hybridrt
