#pragma once

#include <optional>

#include "core/trace/primary_surface.h"

namespace hybridrt {

/// The same for one light (`toward` unit); nothing if the side does not face it.
inline std::optional<ShadowQuery> primary_shadow_query(const Scene& scene, uint32_t triangle, const dvec3& eye,
                                                       const dvec3& dir, const dvec3& toward) {
  const TracedLight light{{toward}};
  std::optional<ShadowQuery> found;
  for_each_facing_light(scene, triangle, eye, dir, {&light, 1},
                        [&](size_t, const ShadowQuery& query) { found = query; });
  return found;
}

}  // namespace hybridrt
