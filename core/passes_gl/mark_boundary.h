#pragma once

#include "core/gl/uniform.h"
#include "core/passes_gl/scene_gpu.h"

namespace hybridrt {

/// Pass 3 of `--shadows blur` (paper, section 3.4): blurs the shadow mask with a k x k box. Where the result is neither
/// dark nor lit, a shadow's edge is near: the pixel is marked and pass 4 asks a ray. Pixels without a surface do not
/// count.
struct MarkBoundaryPass {
  MarkBoundaryPass(const gl::Functions& gl, const gl::ShaderSources& shaders);

  struct In {
    const gl::TextureArray& mask;  ///< R8UI, from pass 2
    int width_px, height_px;
    int kernel_px;  ///< odd, 1 to 31
    int layer = 0;  ///< layer of both masks
  };
  struct Out {
    const gl::Texture& row_sums;          ///< RG8UI scratch
    const gl::TextureArray& marked_mask;  ///< R8UI, `mask` with HRT_MASK_MARKED added
  };
  void run(const In& in, const Out& out) const;

 private:
  struct Step {
    gl::Program program;
    gl::Uniform<int> radius_px{program, "radius_px"}, layer{program, "layer"};
  };

  const gl::Functions& gl_;
  Step rows_, mark_;
};

}  // namespace hybridrt
