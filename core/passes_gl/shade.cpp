#include "core/passes_gl/shade.h"

#include <algorithm>
#include <fmt/format.h>

#include "core/base/check.h"
#include "shaders/shared.h"

namespace hybridrt {
namespace {

gl::ShaderSources with_light_count(gl::ShaderSources shaders, size_t light_count) {
  // With none the compiler would leave the geometry out, and some uniforms with it: then there is a black one.
  shaders["light_count.glsl"] = fmt::format("#define HRT_LIGHT_COUNT {}\n", std::max<size_t>(light_count, 1));
  return shaders;
}

}  // namespace

ShadePass::ShadePass(const gl::Functions& gl, const gl::ShaderSources& shaders, size_t light_count, bool textured)
    : gl_(gl),
      light_count_(light_count),
      textured_(textured),
      program_(gl, with_light_count(shaders, light_count), {textured ? "shade_textured.comp" : "shade.comp"}) {}

void ShadePass::set_lights(const In& in) const {
  HRT_CHECK_EQ(in.lights.size(), light_count_);
  int masked = 0;
  if (in.lights.empty()) program_.set("light[0]", vec3(0));
  for (size_t l = 0; l < in.lights.size(); ++l) {
    program_.set(fmt::format("to_light[{}]", l).c_str(), vec3(in.lights[l].toward));
    program_.set(fmt::format("light[{}]", l).c_str(), in.lights[l].color);
    if (in.mask && in.lights[l].casts_shadow) masked |= 1 << l;
  }
  program_.set("masked_lights", masked);
}

void ShadePass::run(const In& in, const Out& out) const {
  const gl::Functions& gl = gl_;
  in.scene.bind_shading(gl);
  gl.BindTextureUnit(HRT_UNIT_IDS, in.ids.id());
  gl.BindTextureUnit(HRT_UNIT_MASK, in.mask ? in.mask->id() : 0);
  gl.BindTextureUnit(HRT_UNIT_TRACED, in.traced ? in.traced->id() : 0);
  gl.BindImageTexture(HRT_IMAGE_OUT, out.picture.id(), 0, GL_FALSE, 0, GL_WRITE_ONLY, GL_RGBA32F);

  program_.use();
  set_view_uniforms(program_, in.view);
  program_.set("use_traced", in.traced ? 1 : 0);
  set_lights(in);
  program_.set("ambient", in.ambient);
  program_.set("background", in.background);
  if (textured_) program_.set("sample_area", static_cast<float>(in.view.sample_area()));
  gl.MemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT);
  gl.DispatchCompute(group_count(in.view.width_px), group_count(in.view.height_px), 1);
  gl::throw_on_error(gl, "pass 5, shading");
}

}  // namespace hybridrt
