#pragma once

#include <algorithm>

#include "core/base/math.h"

namespace hybridrt {

/// The point of the triangle (a, b, c) nearest to `p`; right for triangles without area too. Source: Ericson, Real-Time
/// Collision Detection, 2005, section 5.1.5, with divisions only by lengths that are not 0.
inline dvec3 closest_on_triangle(const dvec3& p, const dvec3& a, const dvec3& b, const dvec3& c) {
  const auto along = [&p](const dvec3& from, const dvec3& to) {
    const dvec3 edge = to - from;
    const double squared = glm::dot(edge, edge);
    const double share = squared > 0 ? glm::dot(p - from, edge) / squared : 0;
    return from + std::min(std::max(share, 0.0), 1.0) * edge;
  };
  const dvec3 ab = b - a, ac = c - a, ap = p - a, bp = p - b, cp = p - c;
  const double d1 = glm::dot(ab, ap), d2 = glm::dot(ac, ap);
  if (d1 <= 0 && d2 <= 0) return a;
  const double d3 = glm::dot(ab, bp), d4 = glm::dot(ac, bp);
  if (d3 >= 0 && d4 <= d3) return b;
  const double d5 = glm::dot(ab, cp), d6 = glm::dot(ac, cp);
  if (d6 >= 0 && d5 <= d6) return c;
  const double va = d3 * d6 - d5 * d4, vb = d5 * d2 - d1 * d6, vc = d1 * d4 - d3 * d2;
  if (vc <= 0 && d1 >= 0 && d3 <= 0) return along(a, b);
  if (vb <= 0 && d2 >= 0 && d6 <= 0) return along(a, c);
  if (va <= 0 && d4 - d3 >= 0 && d5 - d6 >= 0) return along(b, c);
  return a + (vb * ab + vc * ac) / (va + vb + vc);
}

/// The square of the distance from `p` to the triangle.
inline double squared_distance_to_triangle(const dvec3& p, const dvec3& a, const dvec3& b, const dvec3& c) {
  const dvec3 gap = p - closest_on_triangle(p, a, b, c);
  return glm::dot(gap, gap);
}

}  // namespace hybridrt
