#include "core/trace/kd_clip.h"

#include <cmath>

namespace hybridrt {
namespace {

// A convex polygon gains at most one corner per plane: 9 after six planes. Rounding may make the polygon slightly
// concave; twice that room is never reached, and the loop stops there all the same.
constexpr int kMaxCorners = 18;

struct Polygon {
  dvec3 corners[kMaxCorners];
  int count = 0;
};

/// Keeps the part where `sign * coordinate <= sign * plane`.
void clip_by_plane(Polygon& polygon, int axis, double plane, double sign) {
  bool crossed = false;
  for (int i = 0; i < polygon.count; ++i) crossed |= sign * (polygon.corners[i][axis] - plane) > 0;
  if (!crossed) return;

  Polygon kept;
  for (int i = 0; i < polygon.count; ++i) {
    const dvec3 &from = polygon.corners[i], &to = polygon.corners[i + 1 == polygon.count ? 0 : i + 1];
    const double from_outside = sign * (from[axis] - plane), to_outside = sign * (to[axis] - plane);
    if (from_outside <= 0) kept.corners[kept.count++] = from;
    if ((from_outside < 0 && to_outside > 0) || (from_outside > 0 && to_outside < 0)) {
      dvec3 crossing = from + (to - from) * (from_outside / (from_outside - to_outside));
      crossing[axis] = plane;
      kept.corners[kept.count++] = crossing;
    }
    if (kept.count + 2 > kMaxCorners) return;  // the unclipped polygon is still a valid bound
  }
  polygon = kept;
}

float round_down(double x) {
  const float rounded = static_cast<float>(x);
  return rounded > x ? std::nextafter(rounded, -std::numeric_limits<float>::infinity()) : rounded;
}

}  // namespace

std::optional<Aabb> clip_triangle(const vec3& v0, const vec3& v1, const vec3& v2, const Aabb& box, double margin) {
  Polygon polygon{{dvec3(v0), dvec3(v1), dvec3(v2)}, 3};
  for (int axis = 0; axis < 3 && polygon.count > 0; ++axis) {
    clip_by_plane(polygon, axis, box.lo[axis] - margin, -1);
    clip_by_plane(polygon, axis, box.hi[axis] + margin, +1);
  }
  if (polygon.count == 0) return std::nullopt;

  dvec3 lo = polygon.corners[0], hi = lo;
  for (int i = 1; i < polygon.count; ++i) {
    lo = glm::min(lo, polygon.corners[i]);
    hi = glm::max(hi, polygon.corners[i]);
  }
  Aabb bounds;
  for (int axis = 0; axis < 3; ++axis) {
    bounds.lo[axis] = std::clamp(round_down(lo[axis]), box.lo[axis], box.hi[axis]);
    bounds.hi[axis] = std::clamp(-round_down(-hi[axis]), box.lo[axis], box.hi[axis]);
  }
  return bounds;
}

}  // namespace hybridrt
