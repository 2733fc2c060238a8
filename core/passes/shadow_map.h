#pragma once

#include "core/passes/scene_gpu.h"
#include "core/scene/light_frame.h"

namespace hybridrt {

/// Pass 1 (paper, section 3.4): the depth of the nearest surface as the light sees it, geometry only.
/// Orthographic, fitted to the whole scene, so that it can be kept while light and scene stand still.
struct ShadowMapPass {
  /// `holes`: of SceneGpu::has_holes().
  ShadowMapPass(const gl::Functions& gl, const gl::ShaderSources& shaders, bool holes = false);

  struct In {
    const SceneGpu& scene;
    const LightFrame& light;
    int size_px;
  };
  /// Texture coordinates and depth in the map are in.light.unit_from_scene() of a position.
  struct Out {
    const gl::Framebuffer& depth;  ///< DEPTH_COMPONENT32F, size_px square, 0 at the light, 1 farthest
  };
  void run(const In& in, const Out& out) const;

 private:
  const gl::Functions& gl_;
  const bool holes_;
  gl::Program program_;
};

}  // namespace hybridrt
