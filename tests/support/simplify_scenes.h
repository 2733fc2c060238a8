#pragma once

#include <algorithm>
#include <limits>
#include <vector>

#include "core/mesh/triangle_distance.h"
#include "tests/support/built_normals.h"
#include "tests/support/topology_scenes.h"

namespace hybridrt {

/// An even grid over [0, 1] x [0, 1], of `steps` by `steps` squares cut in two, with y = height(x, z).
template <typename Height>
Scene terrain_scene(int steps, const Height& height) {
  std::vector<vec3> positions;
  std::vector<uvec3> triangles;
  for (int j = 0; j <= steps; ++j)
    for (int i = 0; i <= steps; ++i) {
      const float x = static_cast<float>(i) / steps, z = static_cast<float>(j) / steps;
      positions.emplace_back(x, height(x, z), z);
    }
  const auto row = static_cast<uint32_t>(steps + 1);
  for (int j = 0; j < steps; ++j)
    for (int i = 0; i < steps; ++i) {
      const auto a = static_cast<uint32_t>(j) * row + static_cast<uint32_t>(i);
      triangles.push_back({a, a + row, a + 1});
      triangles.push_back({a + 1, a + row, a + row + 1});
    }
  return bare_scene(std::move(positions), std::move(triangles));
}

/// The distance of a point from the nearest of all triangles: the oracle.
inline double brute_force_distance(const Scene& scene, const dvec3& p) {
  double least = std::numeric_limits<double>::infinity();
  for (uint32_t t = 0; t < scene.triangle_count(); ++t)
    least = std::min(least, squared_distance_to_triangle(p, dvec3(scene.vertex(t, 0)), dvec3(scene.vertex(t, 1)),
                                                         dvec3(scene.vertex(t, 2))));
  return std::sqrt(least);
}

inline std::vector<float> even_bounds(const Scene& scene, float bound) {
  return std::vector<float>(scene.triangle_count(), bound);
}

}  // namespace hybridrt
