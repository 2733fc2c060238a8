#pragma once

#include "core/trace/surface_at.h"

namespace hybridrt {

/// The rays that a surface reflects and refracts, and how much of their light the incoming ray gets.
template <typename Real>
struct Scattered {
  Vec3<Real> reflected_dir{0}, refracted_dir{0};        ///< unit
  Vec3<Real> reflected_weight{0}, refracted_weight{0};  ///< 0: no such ray
};

/// Share of unpolarised light that a boundary reflects. `eta` = index on the ray's side / index beyond; `cos_in`,
/// `cos_out` >= 0. Fresnel's equations.
template <typename Real>
Real fresnel_dielectric(Real cos_in, Real cos_out, Real eta) {
  const Real parallel = (cos_in - eta * cos_out) / (cos_in + eta * cos_out);
  const Real perpendicular = (eta * cos_in - cos_out) / (eta * cos_in + cos_out);
  return Real(0.5) * (parallel * parallel + perpendicular * perpendicular);
}

/// `reflect`: Material::reflect with its textures. `dir`: the unit direction of the incoming ray. Where an interpolated
/// normal would send a ray under the surface, the geometric normal is used.
template <typename Real>
Scattered<Real> scatter(const Material& material, const Vec3<Real>& reflect, const Surface<Real>& surface,
                        const Vec3<Real>& dir) {
  using V = Vec3<Real>;
  Scattered<Real> out;
  const V transmit(material.transmit);

  V normal = surface.normal;
  if (glm::dot(dir, normal) > 0) normal = surface.side;  // seen from behind its interpolated normal
  const Real cos_in = std::min(-glm::dot(dir, normal), Real(1));

  out.reflected_dir = glm::reflect(dir, normal);
  if (glm::dot(out.reflected_dir, surface.side) <= 0) out.reflected_dir = glm::reflect(dir, surface.side);
  out.reflected_weight = reflect;
  out.refracted_weight = transmit;

  if (material.fresnel == Fresnel::schlick) {
    const Real x = 1 - cos_in;
    out.reflected_weight = reflect + (Real(1) - reflect) * (x * x * x * x * x);
  }
  if (transmit == V(0)) return out;

  out.refracted_dir = dir;
  if (material.ni == 1) return out;
  const Real eta = surface.from_outside ? Real(1) / Real(material.ni) : Real(material.ni);
  const Real cos_out_squared = 1 - eta * eta * (1 - cos_in * cos_in);
  if (cos_out_squared <= 0) {  // total internal reflection
    out.reflected_weight = V(1);
    out.refracted_weight = V(0);
    return out;
  }
  const Real cos_out = std::sqrt(cos_out_squared);
  out.refracted_dir = glm::normalize(eta * dir + (eta * cos_in - cos_out) * normal);
  if (glm::dot(out.refracted_dir, surface.side) >= 0) out.refracted_dir = dir;
  if (material.fresnel == Fresnel::dielectric) {
    const Real reflected = fresnel_dielectric(cos_in, cos_out, eta);
    out.reflected_weight = V(reflected);
    out.refracted_weight = (1 - reflected) * transmit;
  }
  return out;
}

template <typename Real>
Scattered<Real> scatter(const Material& material, const Surface<Real>& surface, const Vec3<Real>& dir) {
  return scatter(material, Vec3<Real>(material.reflect), surface, dir);
}

}  // namespace hybridrt
