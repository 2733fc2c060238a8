#include "core/mesh/topology_edges.h"

#include <algorithm>
#include <atomic>

#include "core/base/check.h"

namespace hybridrt {
namespace {

constexpr size_t kTriangleGrain = 1 << 14, kVertexGrain = 1 << 12;

/// A side of a triangle, filed under its smaller vertex: the larger vertex, the triangle, the direction, from
/// the highest bits to the lowest, so that sorting brings the sides of one edge together.
uint64_t side_key(uint32_t larger, size_t triangle, bool reversed) {
  return uint64_t{larger} << 32 | triangle << 1 | uint64_t{reversed};
}
uint32_t larger_of(uint64_t side) { return static_cast<uint32_t>(side >> 32); }
EdgeUse use_of(uint64_t side) {
  EdgeUse use;
  use.triangle = static_cast<uint32_t>(side) >> 1;
  use.reversed = side & 1;
  return use;
}

/// Calls `body(smaller, side)` for the three sides of each triangle of the range.
template <typename Body>
void for_each_side(std::span<const uvec3> triangles, size_t begin, size_t end, const Body& body) {
  for (size_t t = begin; t < end; ++t) {
    const uvec3& corners = triangles[t];
    if (is_degenerate(corners)) continue;
    for (int k = 0; k < 3; ++k) {
      const uint32_t from = corners[k], to = corners[(k + 1) % 3];
      body(std::min(from, to), side_key(std::max(from, to), t, to < from));
    }
  }
}

/// The sides at each smaller vertex: sides[starts[v] .. starts[v + 1]), sorted.
struct SidesOfVertices {
  std::vector<uint32_t> starts;
  std::vector<uint64_t> sides;
  std::vector<uint32_t> edges_of_chunk;  ///< number of distinct edges per kVertexGrain vertices
};

SidesOfVertices sorted_sides(std::span<const uvec3> triangles, size_t vertices, ThreadPool& pool) {
  SidesOfVertices result;
  std::vector<uint32_t>& starts = result.starts;
  starts.assign(vertices + 2, 0);
  parallel_for(pool, triangles.size(), kTriangleGrain, [&](size_t begin, size_t end) {
    for_each_side(triangles, begin, end, [&](uint32_t smaller, uint64_t) {
      std::atomic_ref(starts[smaller + 2]).fetch_add(1, std::memory_order_relaxed);
    });
  });
  for (size_t v = 2; v < starts.size(); ++v) starts[v] += starts[v - 1];

  // Threads store sides in any order; sorting each vertex's few sides makes the order unique. starts[v + 1] is the next
  // free place of v, and in the end the first place of v + 1.
  result.sides.resize(starts.back());
  parallel_for(pool, triangles.size(), kTriangleGrain, [&](size_t begin, size_t end) {
    for_each_side(triangles, begin, end, [&](uint32_t smaller, uint64_t side) {
      const std::atomic_ref next(starts[smaller + 1]);
      result.sides[next.fetch_add(1, std::memory_order_relaxed)] = side;
    });
  });
  starts.pop_back();

  result.edges_of_chunk.resize((vertices + kVertexGrain - 1) / kVertexGrain);
  parallel_for(pool, vertices, kVertexGrain, [&](size_t begin, size_t end) {
    uint32_t edges = 0;
    for (size_t v = begin; v < end; ++v) {
      const std::span at = std::span(result.sides).subspan(starts[v], starts[v + 1] - starts[v]);
      std::sort(at.begin(), at.end());
      for (size_t i = 0; i < at.size(); ++i) edges += i == 0 || larger_of(at[i]) != larger_of(at[i - 1]);
    }
    result.edges_of_chunk[begin / kVertexGrain] = edges;
  });
  return result;
}

}  // namespace

void build_edges(std::span<const uvec3> triangles, size_t vertices, ThreadPool& pool, Topology& topology) {
  HRT_CHECK(triangles.size() <= size_t{1} << 30);  // three uses each in 32 bits
  const SidesOfVertices sorted = sorted_sides(triangles, vertices, pool);

  std::vector<uint32_t> first_edge;  // per chunk, the number of its first edge
  uint32_t edges = 0;
  for (uint32_t count : sorted.edges_of_chunk) first_edge.push_back(edges), edges += count;
  topology.edges.resize(edges);
  topology.edge_count = edges;
  topology.first_use.resize(edges + size_t{1});
  topology.first_use[edges] = static_cast<uint32_t>(sorted.sides.size());
  topology.uses.resize(sorted.sides.size());
  parallel_for(pool, vertices, kVertexGrain, [&](size_t begin, size_t end) {
    uint32_t edge = first_edge[begin / kVertexGrain];
    for (size_t v = begin; v < end; ++v)
      for (uint32_t i = sorted.starts[v]; i < sorted.starts[v + 1]; ++i) {
        const uint64_t side = sorted.sides[i];
        topology.uses[i] = use_of(side);
        if (i > sorted.starts[v] && larger_of(side) == larger_of(sorted.sides[i - 1])) continue;
        topology.edges[edge] = {static_cast<uint32_t>(v), larger_of(side)};
        topology.first_use[edge++] = i;
      }
  });
}

}  // namespace hybridrt
