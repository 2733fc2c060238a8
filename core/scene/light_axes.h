#pragma once

#include <cmath>

#include "core/base/math.h"

namespace hybridrt {

/// Two directions across the light's. x, y, toward are a right-handed orthonormal frame.
struct LightAxes {
  dvec3 x, y;
};

/// `toward` must be unit.
inline LightAxes light_axes(const dvec3& toward) {
  const dvec3 other = std::abs(toward.y) < 0.9 ? dvec3(0, 1, 0) : dvec3(1, 0, 0);
  const dvec3 x = glm::normalize(glm::cross(other, toward));
  return {x, glm::cross(toward, x)};
}

}  // namespace hybridrt
