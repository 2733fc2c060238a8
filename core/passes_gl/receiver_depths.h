#pragma once

#include "core/gl/program.h"
#include "core/passes_gl/scene_gpu.h"

namespace hybridrt {

/// Before pass 1, where its map is fitted to what is seen: how near and how far each block of pixels sees.
struct ReceiverDepthsPass {
  ReceiverDepthsPass(const gl::Functions& gl, const gl::ShaderSources& shaders);

  struct In {
    const gl::Texture& depth;  ///< of IdBufferPass
    int width_px, height_px;
  };
  struct Out {
    const gl::Texture& blocks;  ///< RG32F, a texel a block: the nearest and the farthest depth, or (0, 2): nothing seen
  };
  void run(const In& in, const Out& out) const;

 private:
  const gl::Functions& gl_;
  gl::Program program_;
};

}  // namespace hybridrt
