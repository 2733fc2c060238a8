#pragma once

#include <optional>
#include <span>
#include <vector>

#include "core/passes_gl/scene_gpu.h"
#include "core/passes_gl/view_uniforms.h"

namespace hybridrt {

/// Pass 5 (paper, section 3.4): ambient + each light's shadow · (diffuse + specular) + traced contribution, once per
/// pixel from its id.
struct ShadePass {
  /// `light_count` is at most HRT_MAX_LIGHTS and compiled in, since a loop of unknown length doubles the time on
  /// llvmpipe even if it is never entered. `textured`, `colored`: whether SceneGpu has textures, and colours.
  ShadePass(const gl::Functions& gl, const gl::ShaderSources& shaders, size_t light_count, bool textured = false,
            bool colored = false);

  struct In {
    const SceneGpu& scene;
    const View& view;
    const gl::Texture& ids;
    const gl::TextureArray* mask;  ///< R8UI, a layer per light: HRT_MASK_LIT where it arrives; null: everywhere
    const gl::Texture* traced;     ///< RGBA32F, added to the colour; null: nothing
    std::span<const DirectionalLight> lights;  ///< `light_count` of them; those without shadows arrive everywhere
    AmbientLight ambient;
    vec3 background;
  };
  struct Out {
    const gl::Texture& picture;  ///< RGBA32F, linear; alpha is one of HRT_ALPHA_*
  };
  void run(const In& in, const Out& out) const;

 private:
  struct LightUniforms {
    gl::Uniform<vec3> toward, color;
  };
  void set_lights(const In& in) const;

  const gl::Functions& gl_;
  const size_t light_count_;
  gl::Program program_;
  ViewUniforms view_{program_};
  std::vector<LightUniforms> lights_;
  gl::Uniform<int> masked_lights_{program_, "masked_lights"}, use_traced_{program_, "use_traced"};
  gl::Uniform<vec3> ambient_{program_, "ambient"}, ambient_slope_{program_, "ambient_slope"},
      background_{program_, "background"};
  std::optional<gl::Uniform<float>> sample_area_;  ///< only with textures
};

}  // namespace hybridrt
