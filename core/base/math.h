#pragma once

#include <cmath>
#include <cstdint>
#include <glm/glm.hpp>
#include <limits>

namespace hybridrt {

using glm::dmat4;
using glm::dvec2;
using glm::dvec3;
using glm::dvec4;
using glm::mat4;
using glm::uvec3;
using glm::vec2;
using glm::vec3;
using glm::vec4;

template <typename Real>
using Vec3 = glm::vec<3, Real, glm::defaultp>;

inline constexpr double kPi = 3.14159265358979323846;

/// "No triangle": what the id buffer holds where nothing is seen, and a Hit that missed.
inline constexpr uint32_t kNoTriangle = 0xFFFFFFFFu;

/// Points are `origin + t * dir` for t in (t_min, t_max). `dir` need not be unit; `t` is in multiples of it.
template <typename Real>
struct Ray {
  Vec3<Real> origin{0};
  Vec3<Real> dir{0, 0, -1};
  Real t_min = 0;
  Real t_max = std::numeric_limits<Real>::infinity();
};

/// `u`, `v` are the barycentric weights of the triangle's second and third vertex.
template <typename Real>
struct Hit {
  Real t = std::numeric_limits<Real>::infinity();
  Real u = 0, v = 0;
  uint32_t triangle = kNoTriangle;

  bool found() const { return triangle != kNoTriangle; }
};

/// Axis-aligned box; the default one is empty (lo > hi) and grows.
struct Aabb {
  vec3 lo{std::numeric_limits<float>::infinity()};
  vec3 hi{-std::numeric_limits<float>::infinity()};

  bool empty() const { return !(lo.x <= hi.x && lo.y <= hi.y && lo.z <= hi.z); }
  vec3 extent() const { return empty() ? vec3(0) : hi - lo; }
  vec3 center() const { return 0.5f * lo + 0.5f * hi; }
  bool holds(const vec3& p) const {
    return lo.x <= p.x && p.x <= hi.x && lo.y <= p.y && p.y <= hi.y && lo.z <= p.z && p.z <= hi.z;
  }
  void grow(const vec3& p) { lo = glm::min(lo, p), hi = glm::max(hi, p); }
  void grow(const Aabb& box) { lo = glm::min(lo, box.lo), hi = glm::max(hi, box.hi); }
};

inline bool all_finite(const dvec3& v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); }

}  // namespace hybridrt
