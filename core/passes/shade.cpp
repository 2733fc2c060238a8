#include "core/passes/shade.h"

#include "shaders/shared.h"

namespace hybridrt {

ShadePass::ShadePass(const gl::Functions& gl, const gl::ShaderSources& shaders, bool textured)
    : gl_(gl),
      textured_(textured),
      program_(textured ? gl::Program(gl, shaders, {"shade_textured.comp"}) : gl::Program(gl, shaders, {"shade.comp"})) {}

void ShadePass::run(const In& in, const Out& out) const {
  const gl::Functions& gl = gl_;
  in.scene.bind_shading(gl);
  gl.BindTextureUnit(HRT_UNIT_IDS, in.ids.id());
  gl.BindTextureUnit(HRT_UNIT_MASK, in.mask ? in.mask->id() : 0);
  gl.BindTextureUnit(HRT_UNIT_TRACED, in.traced ? in.traced->id() : 0);
  gl.BindImageTexture(HRT_IMAGE_OUT, out.picture.id(), 0, GL_FALSE, 0, GL_WRITE_ONLY, GL_RGBA32F);

  program_.use();
  set_view_uniforms(program_, in.view);
  program_.set("use_mask", in.mask ? 1 : 0);
  program_.set("use_traced", in.traced ? 1 : 0);
  program_.set("to_light", vec3(in.to_light));
  program_.set("light", in.light);
  program_.set("ambient", in.ambient);
  program_.set("background", in.background);
  if (textured_) program_.set("sample_area", static_cast<float>(in.view.sample_area()));
  gl.MemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT);
  gl.DispatchCompute(group_count(in.view.width_px), group_count(in.view.height_px), 1);
  gl::throw_on_error(gl, "pass 5, shading");
}

}  // namespace hybridrt
