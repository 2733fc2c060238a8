#include "core/passes_gl/shade.h"

#include <algorithm>
#include <fmt/format.h>

#include "core/base/check.h"
#include "shaders/shared.h"

namespace hybridrt {
namespace {

// Without lights the compiler would drop the geometry and some uniforms with it, so there is always one: black.
size_t compiled_count(size_t light_count) { return std::max<size_t>(light_count, 1); }

gl::ShaderSources with_variant(gl::ShaderSources shaders, size_t light_count, bool colored) {
  shaders["shade_variant.glsl"] = fmt::format("#define HRT_LIGHT_COUNT {}\n{}", compiled_count(light_count),
                                              colored ? "#define HRT_COLORED\n" : "");
  return shaders;
}

}  // namespace

ShadePass::ShadePass(const gl::Functions& gl, const gl::ShaderSources& shaders, size_t light_count, bool textured,
                     bool colored)
    : gl_(gl),
      light_count_(light_count),
      program_(gl, with_variant(shaders, light_count, colored), {textured ? "shade_textured.comp" : "shade.comp"}) {
  for (size_t l = 0; l < compiled_count(light_count); ++l)
    lights_.push_back({{program_, fmt::format("to_light[{}]", l)}, {program_, fmt::format("light[{}]", l)}});
  if (textured) sample_area_.emplace(program_, "sample_area");
}

void ShadePass::set_lights(const In& in) const {
  HRT_CHECK_EQ(in.lights.size(), light_count_);
  int masked = 0;
  if (in.lights.empty()) lights_[0].color.set(vec3(0));
  for (size_t l = 0; l < in.lights.size(); ++l) {
    lights_[l].toward.set(vec3(in.lights[l].toward));
    lights_[l].color.set(in.lights[l].color);
    if (in.mask && in.lights[l].casts_shadow) masked |= 1 << l;
  }
  masked_lights_.set(masked);
}

void ShadePass::run(const In& in, const Out& out) const {
  const gl::Functions& gl = gl_;
  in.scene.bind_shading(gl);
  gl.BindTextureUnit(HRT_UNIT_IDS, in.ids.id());
  gl.BindTextureUnit(HRT_UNIT_MASK, in.mask ? in.mask->id() : 0);
  gl.BindTextureUnit(HRT_UNIT_TRACED, in.traced ? in.traced->id() : 0);
  gl.BindImageTexture(HRT_IMAGE_OUT, out.picture.id(), 0, GL_FALSE, 0, GL_WRITE_ONLY, GL_RGBA32F);

  program_.use();
  view_.set(in.view);
  use_traced_.set(in.traced ? 1 : 0);
  set_lights(in);
  ambient_.set(in.ambient.color);
  ambient_slope_.set(in.ambient.slope);
  background_.set(in.background);
  if (sample_area_) sample_area_->set(static_cast<float>(in.view.sample_area()));
  gl.MemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT);
  gl.DispatchCompute(group_count(in.view.width_px), group_count(in.view.height_px), 1);
  gl::throw_on_error(gl, "pass 5, shading");
}

}  // namespace hybridrt
