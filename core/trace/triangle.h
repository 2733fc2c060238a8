#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <type_traits>

#include "core/base/math.h"

namespace hybridrt {

// Watertight ray-triangle test. Source: Woop, Benthin, Wald, "Watertight Ray/Triangle Intersection",
// JCGT 2(1), 2013.
//
// The scene is sheared so that the ray becomes the axis of its largest direction component; what remains
// is a 2-D point-in-triangle test by three edge functions. Two triangles that share an edge compute that
// edge's function from the same two sheared points, hence exactly negated: no ray slips between them.
// That holds only if a*b - c*d is never fused (the project is compiled with -ffp-contract=off).

/// What a ray contributes to every triangle test.
template <typename Real>
struct ShearedRay {
  Vec3<Real> origin;
  Real sx, sy;     ///< shear of the two minor axes along the major one, in [-1, 1]
  Real sz;         ///< 1 / direction along the major axis
  int kx, ky, kz;  ///< minor, minor, major axis
};

/// `dir` must be finite and not zero.
template <typename Real>
ShearedRay<Real> shear_ray(const Vec3<Real>& origin, const Vec3<Real>& dir) {
  const Vec3<Real> size = glm::abs(dir);
  const int kz = size.x >= size.y ? (size.x >= size.z ? 0 : 2) : (size.y >= size.z ? 1 : 2);
  const int kx = kz == 2 ? 0 : kz + 1;
  const int ky = kx == 2 ? 0 : kx + 1;
  return {origin, dir[kx] / dir[kz], dir[ky] / dir[kz], Real(1) / dir[kz], kx, ky, kz};
}

/// As in Hit, `u` and `v` are the weights of the second and third vertex. `from_front`: the ray meets the side from
/// which the vertices go counterclockwise.
template <typename Real>
struct TriangleHit {
  Real t, u, v;
  bool from_front = true;
};

/// The corners of a triangle in an order that depends on their positions alone (and -0 is 0). Triangles with the same
/// corners are then met at the same `t`, to the last bit, whichever corner they begin with and whichever way they go.
struct OrderedTriangle {
  vec3 a, b, c;
  uint8_t second, third;  ///< which of them, 0 to 2, are the second and the third vertex
  bool turned;            ///< they go the other way round than the vertices
};

inline bool is_before(const vec3& p, const vec3& q) {
  return p.x != q.x ? p.x < q.x : p.y != q.y ? p.y < q.y : p.z < q.z;
}

inline OrderedTriangle in_order(const vec3& v0, const vec3& v1, const vec3& v2) {
  const int before_0 = is_before(v1, v0) + is_before(v2, v0);  // how many corners come first
  const int before_1 = !is_before(v1, v0) + is_before(v2, v1);
  const int before_2 = 3 - before_0 - before_1;
  const vec3* sorted[3];
  sorted[before_0] = &v0, sorted[before_1] = &v1, sorted[before_2] = &v2;
  return {*sorted[0],
          *sorted[1],
          *sorted[2],
          static_cast<uint8_t>(before_1),
          static_cast<uint8_t>(before_2),
          (before_0 + 1) % 3 != before_1};
}

/// Outside this range the float edge functions have overflowed or lost digits to underflow, and the test continues in
/// double.
inline constexpr float kSmallestFloatDet = 1e-36f, kLargestFloatDet = 1e36f;

/// Which side a ray meets, from the sign of twice the area of the sheared corners, seen along the axis.
inline bool met_from_front(double sz, double twice_area, bool turned) {
  return ((twice_area > 0) == (sz > 0)) != turned;
}

/// Whether the ray's line meets the triangle, edges and vertices included, from either side. `t` may have any sign: the
/// caller compares it with its range (a NaN fails every comparison). The float version decides the side of each edge
/// exactly for the sheared (rounded) points. Zero-area triangles must have been left out (is_degenerate): rounding can
/// let a ray hit one.
template <typename Real>
bool intersect_triangle(const ShearedRay<Real>& ray, const OrderedTriangle& triangle, TriangleHit<Real>& hit) {
  const auto& o = ray.origin;  // arrays, as glm's vectors index by branches
  const Real a[3] = {triangle.a.x - o.x, triangle.a.y - o.y, triangle.a.z - o.z};
  const Real b[3] = {triangle.b.x - o.x, triangle.b.y - o.y, triangle.b.z - o.z};
  const Real c[3] = {triangle.c.x - o.x, triangle.c.y - o.y, triangle.c.z - o.z};
  const Real ax = a[ray.kx] - ray.sx * a[ray.kz], ay = a[ray.ky] - ray.sy * a[ray.kz];
  const Real bx = b[ray.kx] - ray.sx * b[ray.kz], by = b[ray.ky] - ray.sy * b[ray.kz];
  const Real cx = c[ray.kx] - ray.sx * c[ray.kz], cy = c[ray.ky] - ray.sy * c[ray.kz];

  // Rounding is monotone: the sign of each of these is right, or the value is zero.
  const Real wa = cx * by - cy * bx;
  const Real wb = ax * cy - ay * cx;
  const Real wc = bx * ay - by * ax;
  if ((wa < 0 || wb < 0 || wc < 0) && (wa > 0 || wb > 0 || wc > 0)) return false;
  const Real det = wa + wb + wc;

  if constexpr (std::is_same_v<Real, float>) {
    const bool on_edge = wa == 0 || wb == 0 || wc == 0;
    const bool in_range = std::abs(det) >= kSmallestFloatDet && std::abs(det) <= kLargestFloatDet;
    if (on_edge || !in_range) {  // in double the products are exact, and so are the signs
      const double da = double(cx) * by - double(cy) * bx;
      const double db = double(ax) * cy - double(ay) * cx;
      const double dc = double(bx) * ay - double(by) * ax;
      if ((da < 0 || db < 0 || dc < 0) && (da > 0 || db > 0 || dc > 0)) return false;
      const double sum = da + db + dc;
      if (sum == 0) return false;  // seen exactly edge-on
      const float weights[3] = {float(da / sum), float(db / sum), float(dc / sum)};
      hit = {float((da * a[ray.kz] + db * b[ray.kz] + dc * c[ray.kz]) / sum * ray.sz), weights[triangle.second],
             weights[triangle.third], met_from_front(ray.sz, sum, triangle.turned)};
      return true;
    }
  } else {
    if (det == 0) return false;
  }
  // Weights first, distances second: their product with the edge functions could overflow.
  const Real per_det = Real(1) / det;
  const Real weights[3] = {wa * per_det, wb * per_det, wc * per_det};
  hit = {(weights[0] * a[ray.kz] + weights[1] * b[ray.kz] + weights[2] * c[ray.kz]) * ray.sz, weights[triangle.second],
         weights[triangle.third], met_from_front(ray.sz, det, triangle.turned)};
  return true;
}

/// Whether the ray's line passes beside the triangle, as intersect_triangle() says in double precision. The corners
/// need no order: that of two decides the sign of their edge function, and nothing else, and turns all three alike.
inline bool is_beside(const ShearedRay<double>& ray, const vec3& v0, const vec3& v1, const vec3& v2) {
  const double* const o = &ray.origin.x;  // glm's vectors index by branches
  const auto sheared = [&](const vec3& vertex) {
    const float* const v = &vertex.x;
    const double along = v[ray.kz] - o[ray.kz];
    return dvec2((v[ray.kx] - o[ray.kx]) - ray.sx * along, (v[ray.ky] - o[ray.ky]) - ray.sy * along);
  };
  const dvec2 a = sheared(v0), b = sheared(v1), c = sheared(v2);
  const double wa = c.x * b.y - c.y * b.x, wb = a.x * c.y - a.y * c.x, wc = b.x * a.y - b.y * a.x;
  return (wa < 0 || wb < 0 || wc < 0) && (wa > 0 || wb > 0 || wc > 0);
}

template <typename Real>
bool intersect_triangle(const ShearedRay<Real>& ray, const vec3& v0, const vec3& v1, const vec3& v2,
                        TriangleHit<Real>& hit) {
  return intersect_triangle(ray, in_order(v0, v1, v2), hit);
}

/// Exactly zero area, up to double precision: differences of floats and their products are exact in double
/// unless the corners' exponents lie far apart.
/// Every acceleration structure leaves these out, so that none is ever hit.
inline bool is_degenerate(const vec3& v0, const vec3& v1, const vec3& v2) {
  const dvec3 e1 = dvec3(v1) - dvec3(v0), e2 = dvec3(v2) - dvec3(v0);
  return e1.y * e2.z == e1.z * e2.y && e1.z * e2.x == e1.x * e2.z && e1.x * e2.y == e1.y * e2.x;
}

/// Whether a direction and origin can be traced at all: finite, and with a direction whose largest
/// component has a finite reciprocal. Casters answer "no hit" for the others.
template <typename Real>
bool is_traceable(const Vec3<Real>& origin, const Vec3<Real>& dir) {
  const Real largest = std::max(std::max(std::abs(dir.x), std::abs(dir.y)), std::abs(dir.z));
  // A NaN or infinity anywhere makes the sum of products non-finite.
  const Real sum = (origin.x + origin.y + origin.z) * 0 + (dir.x + dir.y + dir.z) * 0;
  return sum == 0 && std::isfinite(Real(1) / largest);
}

/// The nearest hit so far of one ray. Of several hits at exactly the same `t` the one whose front the ray meets wins
/// (two-sided models give either side a triangle and a material of its own), then the lowest triangle index, so that
/// the answer does not depend on the order of the tests.
template <typename Real>
struct NearestHit {
  Real t_min, t;  ///< accepted range: (t_min, t), and t itself for triangles that win a tie
  Real u = 0, v = 0;
  uint32_t triangle = kNoTriangle;
  bool from_front = true;

  NearestHit(Real t_min_, Real t_max) : t_min(t_min_), t(t_max) {}

  bool accepts(const TriangleHit<Real>& hit, uint32_t triangle_new) const {
    return hit.t > t_min && (hit.t < t || (hit.t == t && found() && wins_tie(hit.from_front, triangle_new)));
  }
  void offer(const TriangleHit<Real>& hit, uint32_t triangle_new) {
    if (!accepts(hit, triangle_new)) return;
    t = hit.t, u = hit.u, v = hit.v;
    triangle = triangle_new, from_front = hit.from_front;
  }
  bool wins_tie(bool from_front_new, uint32_t triangle_new) const {
    return from_front_new != from_front ? from_front_new : triangle_new < triangle;
  }
  bool found() const { return triangle != kNoTriangle; }
  Hit<Real> result() const { return found() ? Hit<Real>{t, u, v, triangle} : Hit<Real>{}; }
};

}  // namespace hybridrt
