#pragma once

#include "core/gl/program.h"
#include "core/passes_gl/scene_gpu.h"

namespace hybridrt {

/// Before pass 1, if its map is fitted to what is seen: the nearest and the farthest depth per block of pixels.
struct ReceiverDepthsPass {
  ReceiverDepthsPass(const gl::Functions& gl, const gl::ShaderSources& shaders);

  struct In {
    const gl::Texture& depth;  ///< from IdBufferPass
    int width_px, height_px;
  };
  struct Out {
    const gl::Texture& blocks;  ///< RG32F, one texel per block: nearest and farthest depth, or (0, 2): nothing seen
  };
  void run(const In& in, const Out& out) const;

 private:
  const gl::Functions& gl_;
  gl::Program program_;
};

}  // namespace hybridrt
