#pragma once

#include <optional>

#include "core/scene/view.h"
#include "core/trace/light_buffer.h"
#include "core/trace/surface_at.h"

namespace hybridrt {

/// Barycentric weights of the point of `triangle` that a pixel sees, found again from the id in double precision.
/// `dir` unit.
inline dvec3 seen_barycentrics(const Scene& scene, uint32_t triangle, const dvec3& eye, const dvec3& dir) {
  return clamped_barycentrics(dvec3(scene.vertex(triangle, 0)) - eye, dvec3(scene.vertex(triangle, 1)) - eye,
                              dvec3(scene.vertex(triangle, 2)) - eye, dir);
}

/// The point of a triangle that a pixel sees, as lights are asked about it.
struct SeenPoint {
  dvec3 side{0};      ///< geometric normal, not unit, turned to the eye
  ShadowQuery query;  ///< the same for every light

  /// Otherwise it is the unlit side that is seen: that is in shadow without a ray.
  bool faces(const dvec3& toward) const { return glm::dot(side, toward) > 0; }
};

/// What is seen of `triangle` along `dir` (unit) from `eye`, in double precision: the same for every method and
/// shadow mode.
inline SeenPoint seen_point(const Scene& scene, uint32_t triangle, const dvec3& eye, const dvec3& dir) {
  const dvec3 weights = seen_barycentrics(scene, triangle, eye, dir);
  const dvec3 a(scene.vertex(triangle, 0)), e1 = dvec3(scene.vertex(triangle, 1)) - a,
      e2 = dvec3(scene.vertex(triangle, 2)) - a;
  const dvec3 normal = glm::cross(e1, e2);
  const bool from_front = glm::dot(normal, dir) <= 0;
  const dvec3 side = from_front ? normal : -normal;
  const dvec3 point = a + weights.y * e1 + weights.z * e2;
  const dvec3 reach = glm::max(glm::abs(point), glm::max(glm::abs(e1), glm::abs(e2)));
  const double offset = kRelativeOffset<double> * std::max({reach.x, reach.y, reach.z});
  return {side, {point + offset / glm::length(normal) * side, triangle, from_front}};
}

/// The question whether a light (`toward` unit) reaches that point; nothing where it is in shadow without a ray.
inline std::optional<ShadowQuery> primary_shadow_query(const Scene& scene, uint32_t triangle, const dvec3& eye,
                                                       const dvec3& dir, const dvec3& toward) {
  const SeenPoint seen = seen_point(scene, triangle, eye, dir);
  return seen.faces(toward) ? std::optional(seen.query) : std::nullopt;
}

}  // namespace hybridrt
