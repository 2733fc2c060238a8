#pragma once

#include "core/passes/scene_gpu.h"
#include "core/scene/light_frame.h"

namespace hybridrt {

/// Pass 1 (paper, section 3.4): the depth of the nearest surface as the light sees it, geometry only.
/// Orthographic, fitted to the whole scene, so that it can be kept while light and scene stand still.
struct ShadowMapPass {
  ShadowMapPass(const gl::Functions& gl, const gl::ShaderSources& shaders);

  struct In {
    const SceneGpu& scene;
    const LightFrame& light;
    int size_px;
  };
  struct Out {
    const gl::Framebuffer& depth;  ///< DEPTH_COMPONENT32F, size_px square, 0 at the light, 1 farthest
  };
  void run(const In& in, const Out& out) const;

 private:
  const gl::Functions& gl_;
  gl::Program program_;
};

/// Texture coordinates (x, y) and depth in that map, each 0..1, from a scene-space position.
dmat4 shadow_map_from_scene(const LightFrame& light);

}  // namespace hybridrt
