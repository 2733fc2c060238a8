#pragma once

#include <algorithm>
#include <optional>
#include <span>

#include "core/scene/view.h"
#include "core/trace/surface_at.h"
#include "core/trace/trace_job.h"

namespace hybridrt {

/// Barycentric weights of the point of `triangle` that a pixel sees, recomputed from the id in double precision. `dir`
/// must be unit.
inline dvec3 seen_barycentrics(const Scene& scene, uint32_t triangle, const dvec3& eye, const dvec3& dir) {
  return clamped_barycentrics(dvec3(scene.vertex(triangle, 0)) - eye, dvec3(scene.vertex(triangle, 1)) - eye,
                              dvec3(scene.vertex(triangle, 2)) - eye, dir);
}

/// Calls ask(light, query) for each light that the seen side of `triangle` faces; it is in shadow from the others
/// without a ray. The query asks whether the light reaches the point seen along `dir` (unit) from `eye`. It is in
/// double precision, and the same for every light, method and shadow mode.
template <typename Ask>
void for_each_facing_light(const Scene& scene, uint32_t triangle, const dvec3& eye, const dvec3& dir,
                           std::span<const TracedLight> lights, const Ask& ask) {
  const dvec3 weights = seen_barycentrics(scene, triangle, eye, dir);
  const dvec3 a(scene.vertex(triangle, 0)), e1 = dvec3(scene.vertex(triangle, 1)) - a,
                                            e2 = dvec3(scene.vertex(triangle, 2)) - a;
  const dvec3 normal = glm::cross(e1, e2);
  const bool from_front = glm::dot(normal, dir) <= 0;
  const dvec3 side = from_front ? normal : -normal;
  ShadowQuery query;
  for (size_t l = 0; l < lights.size(); ++l) {
    if (glm::dot(side, lights[l].light.toward) <= 0) continue;
    if (query.triangle == kNoTriangle) {
      const dvec3 point = a + weights.y * e1 + weights.z * e2;
      const dvec3 reach = glm::max(glm::abs(point), glm::max(glm::abs(e1), glm::abs(e2)));
      const double offset = kRelativeOffset<double> * std::max({reach.x, reach.y, reach.z});
      query = {point + offset / glm::length(normal) * side, triangle, from_front};
      query.is_precise = true;
    }
    ask(l, query);
  }
}

}  // namespace hybridrt
