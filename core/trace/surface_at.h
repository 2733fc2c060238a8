#pragma once

#include <algorithm>
#include <cmath>

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
  const V p0(scene.vertex(triangle, 0)), p1(scene.vertex(triangle, 1)), p2(scene.vertex(triangle, 2));
  const V e1 = p1 - p0, e2 = p2 - p0;
  const V unnormalized = glm::cross(e1, e2);
  const uvec3& corners = scene.triangle_normals[triangle];
  const V interpolated =
      (1 - u - v) * V(scene.normals[corners[0]]) + u * V(scene.normals[corners[1]]) + v * V(scene.normals[corners[2]]);
  const auto largest = [](const V& w) { return std::max({std::abs(w.x), std::abs(w.y), std::abs(w.z)}); };

  Surface<Real> surface;
  surface.point = p0 + u * e1 + v * e2;
  surface.side = turned_toward(normalized_or(unnormalized, -dir), -dir);
  surface.normal = turned_toward(normalized_or(interpolated, surface.side), surface.side);
  surface.offset = kRelativeOffset<Real> * std::max({largest(surface.point), largest(e1), largest(e2)});
  surface.from_outside = glm::dot(unnormalized, dir) <= 0;
  surface.material = scene.triangle_materials[triangle];
  return surface;
}

/// A ray that leaves `surface` on the side that it was seen from (toward = true) or through it. It starts at its offset
/// from the surface, on the line through the point along `dir`, so that the offset does not change what it meets; at
/// grazing angles, where that would be far along, less so. `dir` must be unit.
template <typename Real>
Ray<Real> leave(const Surface<Real>& surface, const Vec3<Real>& dir, bool toward = true) {
  const Vec3<Real> side = toward ? surface.side : -surface.side;
  const Real cosine = glm::dot(dir, side);
  Ray<Real> ray;
  ray.origin = surface.point + surface.offset * (side + (dir - cosine * side) / std::max(cosine, Real(0.25)));
  ray.dir = dir;
  return ray;
}

}  // namespace hybridrt
