#pragma once

#include <algorithm>
#include <gtest/gtest.h>

#include "core/scene/scene.h"

namespace hybridrt {

/// Expects every edge to be used once in each direction, so that all components are closed and evenly wound; no normal
/// points behind its triangle, and no triangle is degenerate.
inline void expect_closed(const Scene& scene) {
  std::vector<uint64_t> edges;
  size_t behind = 0, degenerate = 0;
  for (uint32_t t = 0; t < scene.triangle_count(); ++t) {
    const dvec3 a(scene.vertex(t, 0)), b(scene.vertex(t, 1)), c(scene.vertex(t, 2));
    const dvec3 face = glm::cross(b - a, c - a);
    const uvec3 p = scene.triangle_positions[t];
    degenerate += face == dvec3(0) || p.x == p.y || p.y == p.z || p.z == p.x;
    for (int k = 0; k < 3; ++k) {
      behind += !(glm::dot(face, dvec3(scene.normals[scene.triangle_normals[t][k]])) > 0);
      edges.push_back(static_cast<uint64_t>(p[k]) << 32 | p[(k + 1) % 3]);
    }
  }
  EXPECT_EQ(behind, 0u);
  EXPECT_EQ(degenerate, 0u);
  std::sort(edges.begin(), edges.end());
  EXPECT_TRUE(std::adjacent_find(edges.begin(), edges.end()) == edges.end()) << "each direction once";
  size_t open = 0;
  for (const uint64_t edge : edges) open += !std::binary_search(edges.begin(), edges.end(), edge << 32 | edge >> 32);
  EXPECT_EQ(open, 0u);
}

/// For each position the smallest index of a connected one.
inline std::vector<uint32_t> components_of(const Scene& scene) {
  std::vector<uint32_t> parent(scene.positions.size());
  for (uint32_t i = 0; i < parent.size(); ++i) parent[i] = i;
  const auto root = [&](uint32_t i) {
    while (parent[i] != i) i = parent[i] = parent[parent[i]];
    return i;
  };
  for (const uvec3& t : scene.triangle_positions)
    for (int k = 1; k < 3; ++k) {
      const uint32_t a = root(t.x), b = root(t[k]);
      parent[std::max(a, b)] = std::min(a, b);
    }
  for (uint32_t i = 0; i < parent.size(); ++i) parent[i] = root(i);
  return parent;
}

/// Expects each closed component to have a volume greater than 0: its faces look outward.
inline void expect_outward(const Scene& scene) {
  const std::vector<uint32_t> component = components_of(scene);
  std::vector<double> volumes(scene.positions.size(), 0);
  for (uint32_t t = 0; t < scene.triangle_count(); ++t) {
    const uint32_t c = component[scene.triangle_positions[t].x];
    const dvec3 origin(scene.positions[c]);
    const dvec3 p = dvec3(scene.vertex(t, 0)) - origin, q = dvec3(scene.vertex(t, 1)) - origin;
    volumes[c] += glm::dot(p, glm::cross(q, dvec3(scene.vertex(t, 2)) - origin));
  }
  for (uint32_t i = 0; i < component.size(); ++i)
    if (component[i] == i) {
      ASSERT_GT(volumes[i], 0) << "the component of vertex " << i;
    }
}

}  // namespace hybridrt
