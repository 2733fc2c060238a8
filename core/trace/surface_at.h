#pragma once

#include <type_traits>

#include "core/scene/scene.h"
#include "core/trace/surface.h"

namespace hybridrt {

/// The surface that a ray met, in scene space, ready for shading and for further rays.
template <typename Real>
struct Surface {
  Vec3<Real> point{0};
  Vec3<Real> side{0};        ///< unit geometric normal, turned toward the ray's origin
  Vec3<Real> normal{0};      ///< unit shading normal, turned to `side`
  Real offset = 0;           ///< how far off the surface new rays must start, along `side` or against it
  bool from_outside = true;  ///< the ray met the front (counter-clockwise) side
  uint32_t material = 0;
};

/// Rounding moves a hit off its triangle by about this share of its largest coordinate or of the triangle's extent; new
/// rays start that far away so that they do not meet the same surface again (Wächter and Binder, Ray Tracing Gems,
/// chapter 6).
template <typename Real>
inline constexpr Real kRelativeOffset = std::is_same_v<Real, float> ? Real(0x1p-18) : Real(0x1p-40);

/// The surface at barycentric weights (1 - u - v, u, v) of `triangle`, met by a ray along `dir`.
template <typename Real>
Surface<Real> surface_at(const Scene& scene, uint32_t triangle, Real u, Real v, const Vec3<Real>& dir) {
  using V = Vec3<Real>;
  const uvec3& n = scene.triangle_normals[triangle];
  const auto met = met_surface(V(scene.vertex(triangle, 0)), V(scene.vertex(triangle, 1)), V(scene.vertex(triangle, 2)),
                               V(scene.normals[n[0]]), V(scene.normals[n[1]]), V(scene.normals[n[2]]), u, v, dir,
                               kRelativeOffset<Real>);
  return {met.point, met.side, met.normal, met.offset, met.from_outside, scene.triangle_materials[triangle]};
}

/// A ray that leaves `surface` on the side that it was seen from (toward = true) or through it, see leaving_origin().
/// `dir` must be unit.
template <typename Real>
Ray<Real> leave(const Surface<Real>& surface, const Vec3<Real>& dir, bool toward = true) {
  Ray<Real> ray;
  ray.origin = leaving_origin(surface.point, toward ? surface.side : -surface.side, surface.offset, dir);
  ray.dir = dir;
  return ray;
}

}  // namespace hybridrt
