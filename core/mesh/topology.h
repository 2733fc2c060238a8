#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/base/parallel.h"
#include "core/scene/scene.h"

namespace hybridrt {

/// Two vertices that at least one triangle joins: indices into Scene::positions after welding (weld.h: the smallest
/// index of equal positions), a < b.
struct Edge {
  uint32_t a, b;
};

/// A triangle at an edge, and its direction along it.
struct EdgeUse {
  uint32_t triangle : 31;
  uint32_t reversed : 1;  ///< 0: from a to b; 1: from b to a
};
static_assert(sizeof(EdgeUse) == 4);

enum class EdgeKind : uint8_t {
  regular,       ///< two triangles, in opposite directions
  boundary,      ///< one triangle
  inconsistent,  ///< two triangles in the same direction: one of them is wound the wrong way
  non_manifold,  ///< three triangles or more
};

enum class Winding : uint8_t {
  none,     ///< not closed, or without volume (a sheet with two sides)
  outward,  ///< counterclockwise seen from outside
  inward,
};

/// Triangles connected by edges, non-manifold ones included. Sharing only a vertex does not connect, so two closed
/// bodies that touch in a point stay two.
struct Component {
  uint32_t first_triangle = 0;  ///< the smallest index of its triangles
  uint32_t triangles = 0;
  uint32_t boundary_edges = 0, inconsistent_edges = 0, non_manifold_edges = 0;
  bool degenerate = false;  ///< one triangle with welded corners, which has no edges
  Winding winding = Winding::none;
  double volume = 0;  ///< scene units cubed, >= 0; 0 unless closed

  bool oriented() const { return inconsistent_edges == 0; }
  bool closed() const {
    return !degenerate && boundary_edges == 0 && inconsistent_edges == 0 && non_manifold_edges == 0;
  }
};

/// How the triangles of a scene are connected once equal positions are one: what has an inside, and which edges may be
/// silhouettes. Only data; 34 bytes per triangle for a closed mesh, 84 where nothing is shared. Why not OpenMesh's
/// half-edges: they hold no non-manifold edges. A million triangles on one thread take 0.11 s against 0.33 s, and
/// shuffled, with vertices of their own, 0.46 s against 2.1 s.
struct Topology {
  std::vector<uint32_t> component_of_triangle;
  std::vector<Component> components;  ///< sorted by first_triangle

  std::vector<Edge> edges;          ///< sorted by a, then b
  std::vector<uint32_t> first_use;  ///< edge e is used by uses[first_use[e] .. first_use[e + 1])
  std::vector<EdgeUse> uses;        ///< sorted by triangle at each edge; none of degenerate triangles

  size_t edge_count = 0;  ///< also known when the edges are freed
  size_t boundary_edges = 0, inconsistent_edges = 0, non_manifold_edges = 0;

  std::span<const EdgeUse> uses_of(size_t edge) const {
    return std::span(uses).subspan(first_use[edge], first_use[edge + 1] - first_use[edge]);
  }
  EdgeKind kind_of(size_t edge) const {
    const std::span<const EdgeUse> at = uses_of(edge);
    if (at.size() != 2) return at.size() == 1 ? EdgeKind::boundary : EdgeKind::non_manifold;
    return at[0].reversed != at[1].reversed ? EdgeKind::regular : EdgeKind::inconsistent;
  }
  const Component& component_of(uint32_t triangle) const { return components[component_of_triangle[triangle]]; }
};

/// The result does not depend on the number of threads. Throws CheckFailed beyond 2^31 positions or 2^30
/// triangles, std::bad_alloc.
Topology build_topology(const Scene& scene, ThreadPool& pool);

/// Frees the edges (30 bytes per triangle of a closed mesh), where only components and counts are asked for any more.
void drop_edges(Topology& topology);

/// Bytes of a finished topology.
size_t memory_bytes(const Topology& topology);

}  // namespace hybridrt
