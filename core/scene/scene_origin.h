#pragma once

#include "core/base/math.h"

namespace hybridrt {

/// A box in world space, in double.
struct WorldBox {
  dvec3 lo{std::numeric_limits<double>::infinity()}, hi{-std::numeric_limits<double>::infinity()};

  void grow(const dvec3& p) { lo = glm::min(lo, p), hi = glm::max(hi, p); }
  double size() const { return glm::max(hi.x - lo.x, glm::max(hi.y - lo.y, hi.z - lo.z)); }  ///< its longest side
};

/// Scene::origin_world of a scene in `box`: 0, unless the box lies farther from the origin than 16 times its size. Then
/// its centre, on a grid as coarse as the box is large: it has few bits, so p - origin is exact in double, and a small
/// change of the box does not move it.
dvec3 choose_scene_origin(const WorldBox& box);

}  // namespace hybridrt
