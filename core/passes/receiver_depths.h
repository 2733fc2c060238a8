#pragma once

#include "core/passes/scene_gpu.h"

#include <span>

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

  static int blocks(int pixels);  ///< along a side of as many pixels

 private:
  const gl::Functions& gl_;
  gl::Program program_;
};

/// Points whose convex hull holds all that is seen, relative to the eye: of each block that sees something the eight
/// corners of the part of the view between its depths. `blocks` as the pass writes them, row 0 on top.
std::vector<dvec3> receiver_hull(const View& view, double near_distance, std::span<const vec2> blocks);

}  // namespace hybridrt
