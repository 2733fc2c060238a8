#include "core/passes_gl/id_buffer.h"

#include "core/passes/shadow_warp.h"
#include "shaders/shared.h"

namespace hybridrt {

IdBufferPass::IdBufferPass(const gl::Functions& gl, const gl::ShaderSources& shaders, bool holes)
    : gl_(gl),
      holes_(holes),
      program_(holes ? gl::Program(gl, shaders, {"id_holes.vert", "id_holes.frag"})
                     : gl::Program(gl, shaders, {"id.vert", "id.frag"})) {}

void IdBufferPass::run(const In& in, const Out& out) const {
  const gl::Functions& gl = gl_;
  const GLuint no_triangle[4] = {kNoTriangle, 0, 0, 0};
  const float infinitely_far = 0;  // reversed depth
  gl.BindFramebuffer(GL_FRAMEBUFFER, out.ids.id());
  // The whole frame's viewport, shifted: a part is rasterised as in the whole frame.
  gl.Viewport(-in.view.x_px, -in.view.y_px, in.view.frame_width_px, in.view.frame_height_px);
  gl.ClipControl(GL_UPPER_LEFT, GL_ZERO_TO_ONE);
  gl.Enable(GL_DEPTH_TEST);
  gl.DepthMask(GL_TRUE);
  gl.DepthFunc(GL_GREATER);
  gl.ClearNamedFramebufferuiv(out.ids.id(), GL_COLOR, 0, no_triangle);
  gl.ClearNamedFramebufferfv(out.ids.id(), GL_DEPTH, 0, &infinitely_far);

  program_.use();
  eye_.set(in.view.eye);
  clip_from_eye_.set(mat4(clip_from_eye(in.view, in.near_distance)));
  if (holes_)
    in.scene.draw_with_holes(gl);
  else
    in.scene.draw(gl);
  gl::throw_on_error(gl, "pass 2, triangle ids");
}

ShadowTestPass::ShadowTestPass(const gl::Functions& gl, const gl::ShaderSources& shaders)
    : gl_(gl), program_(gl, shaders, {"shadow_test.comp"}) {}

void ShadowTestPass::run(const In& in, const Out& out) const {
  const gl::Functions& gl = gl_;
  in.scene.bind_geometry(gl);
  gl.BindTextureUnit(HRT_UNIT_IDS, in.ids.id());
  gl.BindTextureUnit(HRT_UNIT_SHADOW_MAP, in.shadow_map.id());
  gl.BindImageTexture(HRT_IMAGE_OUT, out.mask.id(), 0, GL_FALSE, out.layer, GL_WRITE_ONLY, GL_R8UI);

  program_.use();
  view_.set(in.view);
  map_from_eye_.set(map_from_eye(in.fit, in.view.eye));
  to_light_.set(vec3(in.to_light));
  const shadow_warp_single::MapFit fit = map_fit_of(in.fit);
  inverse_w_slope_.set(fit.inverse_w_slope);
  texel_across_.set(fit.texel_across);
  texel_along_.set(fit.texel_along);
  uniform_texel_.set(fit.uniform_texel);
  misplacement_.set(fit.misplacement);
  lean_first_.set(fit.lean_first);
  lean_step_.set(fit.lean_step);
  warped_.set(fit.warped);
  across_.set(fit.across);
  along_.set(fit.along);
  gl.MemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT);
  gl.DispatchCompute(group_count(in.view.width_px), group_count(in.view.height_px), 1);
  gl::throw_on_error(gl, "pass 2, shadow test");
}

}  // namespace hybridrt
