#pragma once

#include <vector>

#include "core/load/mtl_io.h"
#include "core/mesh/topology.h"

namespace hybridrt {

/// Triangles without normals: enough for topology.
inline Scene bare_scene(std::vector<vec3> positions, std::vector<uvec3> triangles) {
  Scene scene;
  scene.positions = std::move(positions);
  scene.triangle_positions = std::move(triangles);
  scene.triangle_materials.assign(scene.triangle_count(), 0);
  scene.materials = {default_material()};
  scene.bounds = compute_bounds(scene);
  return scene;
}

/// Appends a cube of side 1 with outward winding, its lowest corner at `lo`.
inline void add_cube(Scene& scene, const vec3& lo) {
  const auto base = static_cast<uint32_t>(scene.positions.size());
  for (int i = 0; i < 8; ++i) scene.positions.push_back(lo + vec3(i & 1, i >> 1 & 1, i >> 2));
  static constexpr uint32_t kQuads[6][4] = {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4},
                                            {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}};
  for (const auto& q : kQuads) {
    scene.triangle_positions.push_back(base + uvec3(q[0], q[1], q[2]));
    scene.triangle_positions.push_back(base + uvec3(q[0], q[2], q[3]));
  }
  scene.triangle_materials.resize(scene.triangle_count(), 0);
}

inline Scene cube_scene() {
  Scene scene = bare_scene({}, {});
  add_cube(scene, vec3(0));
  return scene;
}

/// A closed unit sphere with outward winding and shared vertices.
inline Scene sphere_scene(int rings, int segments) {
  std::vector<vec3> positions{{0, 1, 0}, {0, -1, 0}};
  std::vector<uvec3> triangles;
  const auto at = [&](int ring, int segment) -> uint32_t {
    return ring == 0 ? 0 : ring == rings ? 1 : 2 + (ring - 1) * segments + segment % segments;
  };
  for (int ring = 1; ring < rings; ++ring)
    for (int segment = 0; segment < segments; ++segment) {
      const double polar = kPi * ring / rings, azimuth = 2 * kPi * segment / segments;
      positions.push_back(
          vec3(std::sin(polar) * std::cos(azimuth), std::cos(polar), -std::sin(polar) * std::sin(azimuth)));
    }
  for (int ring = 0; ring < rings; ++ring)
    for (int segment = 0; segment < segments; ++segment) {
      const uint32_t a = at(ring, segment), b = at(ring + 1, segment), c = at(ring + 1, segment + 1),
                     d = at(ring, segment + 1);
      if (b != c) triangles.push_back({a, b, c});
      if (a != d) triangles.push_back({a, c, d});
    }
  return bare_scene(std::move(positions), std::move(triangles));
}

/// The same triangles, each with its own vertices.
inline Scene with_own_vertices(const Scene& scene) {
  Scene own = scene;
  own.positions.clear();
  for (uvec3& triangle : own.triangle_positions)
    for (int corner = 0; corner < 3; ++corner) {
      own.positions.push_back(scene.positions[triangle[corner]]);
      triangle[corner] = static_cast<uint32_t>(own.positions.size() - 1);
    }
  return own;
}

inline Topology topology_of(const Scene& scene, int threads = 2) {
  ThreadPool pool(threads);
  return build_topology(scene, pool);
}

}  // namespace hybridrt
