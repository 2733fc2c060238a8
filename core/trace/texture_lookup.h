#pragma once

#include <glm/glm.hpp>
#include <type_traits>

#include "core/scene/scene.h"
#include "core/trace/log2.h"
#include "shaders/shared.h"

// shaders/texture.glsl compiled as C++, in single and in double precision. Its functions look up words, so they are
// members of a struct that holds them.
#define HRT_FN
#define HRT_CHOOSE(condition, a, b) ((condition) ? (a) : (b))
#define HRT_ANY(condition) (condition)
namespace hybridrt::texture_single {
using namespace glm;
struct Lookup {
  using Real = float;
  using Int = int;
  using Uint = uint32_t;
  using Vec2 = glm::vec2;
  using Vec3 = glm::vec3;
  const uint32_t* words;
  uint32_t texture_word(uint32_t i) { return words[i]; }
  uint32_t texel_word(uint32_t i) { return words[i]; }
  static float log2(float x) { return log2_by_series(x); }
#include "shaders/texture.glsl"
#include "shaders/texture_holes.glsl"
};
}  // namespace hybridrt::texture_single

namespace hybridrt::texture_double {
using namespace glm;
struct Lookup {
  using Real = double;
  using Int = int;
  using Uint = uint32_t;
  using Vec2 = glm::dvec2;
  using Vec3 = glm::dvec3;
  const uint32_t* words;
  uint32_t texture_word(uint32_t i) { return words[i]; }
  uint32_t texel_word(uint32_t i) { return words[i]; }
#include "shaders/texture.glsl"
#include "shaders/texture_holes.glsl"
};
}  // namespace hybridrt::texture_double
#undef HRT_FN
#undef HRT_CHOOSE
#undef HRT_ANY

namespace hybridrt {

template <typename Real>
using Vec2 = glm::vec<2, Real, glm::defaultp>;

template <typename Real>
using TextureLookup = std::conditional_t<std::is_same_v<Real, float>, texture_single::Lookup, texture_double::Lookup>;

/// Texture coordinates at barycentric weights (1 - u - v, u, v) of a triangle.
template <typename Real>
Vec2<Real> texcoord_at(const Textures& textures, uint32_t triangle, Real u, Real v) {
  const uvec3& corners = textures.triangle_texcoords[triangle];
  return (1 - u - v) * Vec2<Real>(textures.texcoords[corners[0]]) + u * Vec2<Real>(textures.texcoords[corners[1]]) +
         v * Vec2<Real>(textures.texcoords[corners[2]]);
}

/// The colours of a material at a point, with its textures.
template <typename Real>
struct SurfaceColors {
  Vec3<Real> kd, ks, ke, reflect;
};

/// The colours of a material without maps at weights (1 - u - v, u, v) of `triangle`.
template <typename Real>
SurfaceColors<Real> plain_colors(const Scene& scene, uint32_t triangle, Real u, Real v) {
  const Material& m = scene.material_of(triangle);
  SurfaceColors<Real> colors{Vec3<Real>(m.kd), Vec3<Real>(m.ks), Vec3<Real>(m.ke), Vec3<Real>(m.reflect)};
  if (scene.has_colors()) {
    const uvec3& corners = scene.triangle_colors[triangle];
    colors.kd *= (1 - u - v) * Vec3<Real>(scene.colors[corners[0]]) + u * Vec3<Real>(scene.colors[corners[1]]) +
                 v * Vec3<Real>(scene.colors[corners[2]]);
  }
  return colors;
}

/// The colours that a ray along `dir` (unit) meets at weights (1 - u - v, u, v) of `triangle`, after a path of
/// `distance` from the eye, for a pixel of that solid angle. The material must have maps.
template <typename Real>
SurfaceColors<Real> textured_colors(const Scene& scene, uint32_t triangle, Real u, Real v, const Vec3<Real>& dir,
                                    Real solid_angle, Real distance) {
  using V = Vec3<Real>;
  const Material& m = scene.material_of(triangle);
  const Textures& textures = *scene.textures;
  TextureLookup<Real> lookup{textures.words.data()};
  const V p0(scene.vertex(triangle, 0));
  const uvec3& corners = textures.triangle_texcoords[triangle];
  const Vec2<Real> t0(textures.texcoords[corners[0]]);
  const Real footprint =
      lookup.pixel_footprint(V(scene.vertex(triangle, 1)) - p0, V(scene.vertex(triangle, 2)) - p0,
                             Vec2<Real>(textures.texcoords[corners[1]]) - t0,
                             Vec2<Real>(textures.texcoords[corners[2]]) - t0, dir, solid_angle, distance);
  const Vec2<Real> uv = texcoord_at(textures, triangle, u, v);
  SurfaceColors<Real> colors = plain_colors(scene, triangle, u, v);
  colors.kd = lookup.mapped_color(m.texture_maps, HRT_MAP_DIFFUSE, colors.kd, uv, footprint);
  colors.ke = lookup.mapped_color(m.texture_maps, HRT_MAP_EMITTED, colors.ke, uv, footprint);
  const V specular = lookup.mapped_color(m.texture_maps, HRT_MAP_SPECULAR, V(1), uv, footprint);
  colors.ks *= specular;
  colors.reflect *= specular;
  return colors;
}

}  // namespace hybridrt
