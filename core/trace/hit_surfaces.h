#pragma once

#include <cstdint>

#include "core/trace/surface_at.h"
#include "core/trace/texture_lookup.h"

namespace hybridrt {

/// The surfaces that some rays met, to be worked on together. Structure of arrays; `count` elements of each are used,
/// and more may be written up to whole vectors.
template <typename Real>
struct HitSurfaces {
  static constexpr int kMost = 64, kRoom = kMost + 16;

  // Given.
  int count = 0;
  uint32_t triangle[kRoom];
  alignas(64) Real u[kRoom], v[kRoom];  ///< barycentric weights of the second and third vertex
  alignas(64) Real dir[3][kRoom];       ///< unit: of the ray
  alignas(64) Real solid_angle[kRoom];  ///< of the pixel's sample; if there are textures
  alignas(64) Real distance[kRoom];     ///< from the eye along the path. If there are textures

  // Found by find_surfaces(): see Surface.
  alignas(64) Real point[3][kRoom], side[3][kRoom], normal[3][kRoom], offset[kRoom];
  uint8_t from_outside[kRoom];
  uint32_t material[kRoom];

  Vec3<Real> dir_of(int i) const { return {dir[0][i], dir[1][i], dir[2][i]}; }
  Surface<Real> surface(int i) const {
    const auto at = [i](const auto& values) { return Vec3<Real>(values[0][i], values[1][i], values[2][i]); };
    return {at(point), at(side), at(normal), offset[i], from_outside[i] != 0, material[i]};
  }
};

/// Rays that leave surfaces, one each.
template <typename Real>
struct LeavingRays {
  alignas(64) Real origin[3][HitSurfaces<Real>::kRoom], dir[3][HitSurfaces<Real>::kRoom],
      weight[3][HitSurfaces<Real>::kRoom];
};

/// What scatter() and leave() say of each surface; that of surfaces whose material sends no rays is undefined.
template <typename Real>
struct ScatteredFromHits {
  LeavingRays<Real> reflected, refracted;
};

/// Shadow rays toward a light from the surfaces that face it.
template <typename Real>
struct ShadowOrigins {
  alignas(64) Real origin[3][HitSurfaces<Real>::kRoom];
  uint8_t facing[HitSurfaces<Real>::kRoom];
};

// In single precision many surfaces at once, with the bits of surface_at(), leave() and scatter() under every
// instruction set; in double precision one by one.

void find_surfaces(const Scene& scene, HitSurfaces<float>& hits);
void leave_toward(const HitSurfaces<float>& hits, const vec3& to_light, ShadowOrigins<float>& out);
void scatter_all(const Scene& scene, const HitSurfaces<float>& hits, ScatteredFromHits<float>& out);

void find_surfaces(const Scene& scene, HitSurfaces<double>& hits);
void leave_toward(const HitSurfaces<double>& hits, const dvec3& to_light, ShadowOrigins<double>& out);
void scatter_all(const Scene& scene, const HitSurfaces<double>& hits, ScatteredFromHits<double>& out);

/// Material::reflect of a surface, with textures.
template <typename Real>
Vec3<Real> reflect_of(const Scene& scene, const HitSurfaces<Real>& hits, int i) {
  const Material& m = scene.materials[hits.material[i]];
  if (m.texture_maps == 0) return Vec3<Real>(m.reflect);
  return textured_colors(scene, hits.triangle[i], hits.u[i], hits.v[i], hits.dir_of(i), hits.solid_angle[i],
                         hits.distance[i])
      .reflect;
}

}  // namespace hybridrt
