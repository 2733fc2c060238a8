#include "core/passes_gl/mark_boundary.h"

#include "core/base/check.h"
#include "shaders/shared.h"

namespace hybridrt {

MarkBoundaryPass::MarkBoundaryPass(const gl::Functions& gl, const gl::ShaderSources& shaders)
    : gl_(gl), rows_{{gl, shaders, {"blur_rows.comp"}}}, mark_{{gl, shaders, {"blur_mark.comp"}}} {}

void MarkBoundaryPass::run(const In& in, const Out& out) const {
  HRT_CHECK(in.kernel_px % 2 == 1 && in.kernel_px >= 1 && in.kernel_px <= 31);
  const gl::Functions& gl = gl_;
  const int groups_x = group_count(in.width_px), groups_y = group_count(in.height_px);
  gl.BindTextureUnit(HRT_UNIT_MASK, in.mask.id());

  rows_.program.use();
  rows_.radius_px.set(in.kernel_px / 2);
  rows_.layer.set(in.layer);
  gl.BindImageTexture(HRT_IMAGE_OUT, out.row_sums.id(), 0, GL_FALSE, 0, GL_WRITE_ONLY, GL_RG8UI);
  gl.MemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT);
  gl.DispatchCompute(groups_x, groups_y, 1);

  mark_.program.use();
  mark_.radius_px.set(in.kernel_px / 2);
  mark_.layer.set(in.layer);
  gl.BindTextureUnit(HRT_UNIT_TRACED, out.row_sums.id());
  gl.BindImageTexture(HRT_IMAGE_OUT, out.marked_mask.id(), 0, GL_FALSE, in.layer, GL_WRITE_ONLY, GL_R8UI);
  gl.MemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT);
  gl.DispatchCompute(groups_x, groups_y, 1);
  gl::throw_on_error(gl, "pass 3, marking");
}

}  // namespace hybridrt
