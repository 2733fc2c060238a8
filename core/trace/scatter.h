#pragma once

#include <type_traits>

#include "core/trace/surface_at.h"

namespace hybridrt {

/// The rays that a surface reflects and refracts, and how much of their light the incoming ray gets (optics-inl.h).
template <typename Real>
using Scattered =
    std::conditional_t<std::is_same_v<Real, float>, surface_single::ScatteredRays, surface_double::ScatteredRays>;

/// `reflect`: Material::reflect with its textures. `dir`: the unit direction of the incoming ray.
template <typename Real>
Scattered<Real> scatter(const Material& material, const Vec3<Real>& reflect, const Surface<Real>& surface,
                        const Vec3<Real>& dir) {
  return scattered_rays({reflect, Vec3<Real>(material.transmit), Real(material.ni), material.bends_light(),
                         material.fresnel == Fresnel::schlick, material.fresnel == Fresnel::dielectric},
                        surface.normal, surface.side, surface.from_outside, dir);
}

template <typename Real>
Scattered<Real> scatter(const Material& material, const Surface<Real>& surface, const Vec3<Real>& dir) {
  return scatter(material, Vec3<Real>(material.reflect), surface, dir);
}

}  // namespace hybridrt
