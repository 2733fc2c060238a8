#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/base/math.h"
#include "core/scene/texture_map.h"

namespace hybridrt {

/// How the weight of a mirror ray depends on the angle.
enum class Fresnel {
  none,        ///< constant
  schlick,     ///< opaque mirror: reflect + (1 - reflect)(1 - cos)^5
  dielectric,  ///< exact Fresnel equations from `ni`; reflection and transmission share the light
};

/// A surface as MTL describes it, plus what the tracer derives from it once (see resolve_material).
/// All colours linear.
struct Material {
  std::string name;
  vec3 kd{0.8f};      ///< diffuse
  vec3 ks{0};         ///< specular
  vec3 ke{0};         ///< emitted
  float ns = 0;       ///< Blinn-Phong exponent; 0: no highlight, whatever ks is
  float ni = 1;       ///< index of refraction, > 0
  float opacity = 1;  ///< MTL d: 1 opaque, 0 clear
  vec3 tf{1};         ///< transmission filter
  int illum = 2;
  std::vector<TextureMap> maps;  ///< at most one per kind; they multiply what they change
  uint32_t texture_maps = 0;     ///< their place in Textures; 0: none

  vec3 reflect{0};   ///< weight of a mirror ray at normal incidence; 0 = none
  vec3 transmit{0};  ///< weight of a refracted ray; 0 = none
  Fresnel fresnel = Fresnel::none;

  bool reflective() const { return reflect != vec3(0) || fresnel != Fresnel::none; }
  bool transmissive() const { return transmit != vec3(0); }
  bool bends_light() const { return transmissive() && ni != 1; }
};

/// Fills `reflect`, `transmit`, `fresnel` (and drops `ks` where MTL says so) from the other members.
/// The table, after the MTL specification:
///   illum 0, 1    diffuse only                     no ray
///   illum 2, 10   + Blinn-Phong highlight          no ray
///   illum 3, 8    + mirror                         reflect = Ks
///   illum 5       + mirror with Fresnel            reflect = Ks, Schlick
///   illum 4, 9    glass                            transmit = Tf, reflect = Ks (Ni = 1) or dielectric
///   illum 6, 7    glass                            as 4
/// Any material with d < 1 lets (1 - d)·Tf through (straight on unless it is glass), and its diffuse
/// part counts d-fold.
void resolve_material(Material& material);

}  // namespace hybridrt
