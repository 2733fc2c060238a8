#pragma once

#include "core/base/math.h"
#include "core/scene/scene.h"
#include "core/trace/holes.h"
#include "core/trace/light_buffer.h"
#include "core/trace/triangle.h"

namespace hybridrt {

/// The oracle of the tests: tests every triangle. Same contract as RayCaster::closest_hits for one ray; double is the
/// truth, float what a float caster should answer to the last bit.
template <typename Real>
Hit<Real> brute_force_hit(const Scene& scene, const Ray<Real>& ray) {
  if (!is_traceable(ray.origin, ray.dir)) return {};
  const ShearedRay<Real> sheared = shear_ray(ray.origin, ray.dir);
  NearestHit<Real> nearest(ray.t_min, ray.t_max);
  for (uint32_t triangle = 0; triangle < scene.triangle_count(); ++triangle) {
    const vec3 a = scene.vertex(triangle, 0), b = scene.vertex(triangle, 1), c = scene.vertex(triangle, 2);
    TriangleHit<Real> hit;
    if (is_degenerate(a, b, c) || !intersect_triangle(sheared, a, b, c, hit)) continue;
    if (scene.has_holes() && is_hole(*scene.textures, triangle, hit.u, hit.v)) continue;
    nearest.offer(hit, triangle);
  }
  return nearest.result();
}

/// Any triangle but the query's own between its origin and the light, or kNoTriangle: what shadow_answers() must find.
inline uint32_t brute_force_occluder(const Scene& scene, const dvec3& toward, const ShadowQuery& query) {
  const ShearedRay<double> ray = shear_ray(query.origin, toward);
  for (uint32_t triangle = 0; triangle < scene.triangle_count(); ++triangle) {
    const vec3 a = scene.vertex(triangle, 0), b = scene.vertex(triangle, 1), c = scene.vertex(triangle, 2);
    TriangleHit<double> hit;
    if (triangle == query.triangle || is_degenerate(a, b, c) || !intersect_triangle(ray, a, b, c, hit)) continue;
    if (scene.has_holes() && is_hole(*scene.textures, triangle, hit.u, hit.v)) continue;
    if (hit.t > 0) return triangle;
  }
  return kNoTriangle;
}

}  // namespace hybridrt
