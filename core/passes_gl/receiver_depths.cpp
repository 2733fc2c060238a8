#include "core/passes_gl/receiver_depths.h"

#include "core/passes/receiver_hull.h"
#include "shaders/shared.h"

namespace hybridrt {

ReceiverDepthsPass::ReceiverDepthsPass(const gl::Functions& gl, const gl::ShaderSources& shaders)
    : gl_(gl), program_(gl, shaders, {"receiver_depths.comp"}) {}

void ReceiverDepthsPass::run(const In& in, const Out& out) const {
  const gl::Functions& gl = gl_;
  gl.BindTextureUnit(HRT_UNIT_DEPTH, in.depth.id());
  gl.BindImageTexture(HRT_IMAGE_OUT, out.blocks.id(), 0, GL_FALSE, 0, GL_WRITE_ONLY, GL_RG32F);
  program_.use();
  gl.DispatchCompute(group_count(receiver_blocks(in.width_px)), group_count(receiver_blocks(in.height_px)), 1);
  gl::throw_on_error(gl, "pass 1, receivers' depths");
}

}  // namespace hybridrt
