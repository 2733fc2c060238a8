#include "core/passes_gl/shadow_map.h"

namespace hybridrt {

ShadowMapPass::ShadowMapPass(const gl::Functions& gl, const gl::ShaderSources& shaders, bool holes)
    : gl_(gl),
      holes_(holes),
      program_(holes ? gl::Program(gl, shaders, {"shadow_map_holes.vert", "shadow_map_holes.frag"})
                     : gl::Program(gl, shaders, {"shadow_map.vert"})) {}

void ShadowMapPass::run(const In& in, const Out& out) const {
  const gl::Functions& gl = gl_;
  const float farthest = 1;
  gl.BindFramebuffer(GL_FRAMEBUFFER, out.depth.id());
  gl.Viewport(0, 0, in.size_px, in.size_px);
  gl.ClipControl(GL_LOWER_LEFT, GL_NEGATIVE_ONE_TO_ONE);
  gl.Enable(GL_DEPTH_TEST);
  gl.DepthMask(GL_TRUE);
  gl.DepthFunc(GL_LESS);
  gl.ClearNamedFramebufferfv(out.depth.id(), GL_DEPTH, 0, &farthest);

  // x and y from 0..1 to clip space's -1..1; depth is -1..1 in both. What lies behind a warp's pole has w < 0 and is
  // clipped.
  dmat4 clip_from_map(1);
  clip_from_map[0][0] = clip_from_map[1][1] = 2;
  clip_from_map[3][0] = clip_from_map[3][1] = -1;
  program_.use();
  origin_.set(in.fit.origin);
  clip_from_origin_.set(mat4(clip_from_map * in.fit.map_from_origin));
  if (holes_)
    in.scene.draw_with_holes(gl);
  else
    in.scene.draw(gl);
  gl::throw_on_error(gl, "pass 1, shadow map");
}

}  // namespace hybridrt
