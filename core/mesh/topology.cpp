#include "core/mesh/topology.h"

#include <atomic>
#include <cmath>

#include "core/base/check.h"
#include "core/base/memory.h"
#include "core/mesh/topology_edges.h"
#include "core/mesh/weld.h"

namespace hybridrt {
namespace {

constexpr size_t kGrain = 1 << 14;
constexpr double kNoVolume = 1e-12;  // as a share of the sum of all parts' absolute values

/// Disjoint sets that threads may unite concurrently. A link always leads to a smaller number, so that in the end each
/// set's root is its smallest member, whatever the order. Source: Anderson and Woll, Wait-free Parallel Algorithms for
/// the Union-Find Problem, 1991.
class Sets {
 public:
  Sets(std::vector<uint32_t>& parents) : parents_(parents) {}

  uint32_t root(uint32_t member) {
    for (;;) {
      uint32_t parent = at(member).load(std::memory_order_relaxed);
      if (parent == member) return member;
      const uint32_t grandparent = at(parent).load(std::memory_order_relaxed);
      if (grandparent != parent)  // path halving
        at(member).compare_exchange_weak(parent, grandparent, std::memory_order_relaxed);
      member = grandparent;
    }
  }

  void unite(uint32_t a, uint32_t b) {
    for (;;) {
      a = root(a), b = root(b);
      if (a == b) return;
      if (a < b) std::swap(a, b);
      uint32_t still_root = a;
      if (at(a).compare_exchange_strong(still_root, b, std::memory_order_relaxed)) return;
    }
  }

 private:
  std::atomic_ref<uint32_t> at(uint32_t member) { return std::atomic_ref(parents_[member]); }
  std::vector<uint32_t>& parents_;
};

std::vector<uvec3> welded_triangles(const Scene& scene, ThreadPool& pool) {
  const std::vector<uint32_t> welded = weld_positions(scene.positions, pool);
  std::vector<uvec3> triangles(scene.triangle_count());
  parallel_for(pool, triangles.size(), kGrain, [&](size_t begin, size_t end) {
    for (size_t i = begin; i < end; ++i) {
      const uvec3& corners = scene.triangle_positions[i];
      triangles[i] = {welded[corners.x], welded[corners.y], welded[corners.z]};
    }
  });
  return triangles;
}

/// Unites the triangles of each edge; returns the edges that are not regular, in order.
std::vector<uint32_t> unite_at_edges(Topology& topology, ThreadPool& pool) {
  const size_t edges = topology.edges.size();
  std::vector<std::vector<uint32_t>> irregular((edges + kGrain - 1) / kGrain);
  Sets sets(topology.component_of_triangle);
  parallel_for(pool, edges, kGrain, [&](size_t begin, size_t end) {
    for (size_t edge = begin; edge < end; ++edge) {
      const std::span<const EdgeUse> uses = topology.uses_of(edge);
      for (size_t i = 1; i < uses.size(); ++i) sets.unite(uses[0].triangle, uses[i].triangle);
      if (topology.kind_of(edge) != EdgeKind::regular) irregular[begin / kGrain].push_back(static_cast<uint32_t>(edge));
    }
  });
  parallel_for(pool, topology.component_of_triangle.size(), kGrain, [&](size_t begin, size_t end) {
    for (size_t i = begin; i < end; ++i) {
      const uint32_t root = sets.root(static_cast<uint32_t>(i));
      std::atomic_ref(topology.component_of_triangle[i]).store(root, std::memory_order_relaxed);
    }
  });
  std::vector<uint32_t> all;
  for (const std::vector<uint32_t>& part : irregular) all.insert(all.end(), part.begin(), part.end());
  return all;
}

/// Replaces each triangle's root by the number of its component.
void number_components(Topology& topology, std::span<const uvec3> triangles) {
  std::vector<uint32_t>& of = topology.component_of_triangle;
  for (uint32_t i = 0; i < of.size(); ++i) {
    if (of[i] == i) {
      of[i] = static_cast<uint32_t>(topology.components.size());
      Component& component = topology.components.emplace_back();
      component.first_triangle = i;
      component.degenerate = is_degenerate(triangles[i]);
    } else {
      of[i] = of[of[i]];  // the root comes first and already has its number
    }
    ++topology.components[of[i]].triangles;
  }
}

void count_irregular_edges(Topology& topology, std::span<const uint32_t> irregular) {
  for (uint32_t edge : irregular) {
    Component& component = topology.components[topology.component_of_triangle[topology.uses_of(edge)[0].triangle]];
    switch (topology.kind_of(edge)) {
      case EdgeKind::regular: break;
      case EdgeKind::boundary: ++component.boundary_edges, ++topology.boundary_edges; break;
      case EdgeKind::inconsistent: ++component.inconsistent_edges, ++topology.inconsistent_edges; break;
      case EdgeKind::non_manifold: ++component.non_manifold_edges, ++topology.non_manifold_edges; break;
    }
  }
}

/// Six times the volume, as the sum of tetrahedra over the triangles; `size` sums their absolute values.
struct SignedVolume {
  double value = 0, size = 0;
};

/// Consecutive triangles of one component.
struct Run {
  uint32_t component;
  SignedVolume part;
};

void measure_volumes(const Scene& scene, ThreadPool& pool, Topology& topology) {
  const size_t count = scene.triangle_count();
  std::vector<std::vector<Run>> runs((count + kGrain - 1) / kGrain);
  parallel_for(pool, count, kGrain, [&](size_t begin, size_t end) {
    std::vector<Run>& own = runs[begin / kGrain];
    for (size_t i = begin; i < end; ++i) {
      const uint32_t number = topology.component_of_triangle[i];
      const Component& component = topology.components[number];
      if (!component.closed()) continue;
      if (own.empty() || own.back().component != number) own.push_back({number, {}});
      const auto triangle = static_cast<uint32_t>(i);
      const dvec3 apex(scene.vertex(component.first_triangle, 0));
      const dvec3 a = dvec3(scene.vertex(triangle, 0)) - apex, b = dvec3(scene.vertex(triangle, 1)) - apex,
                  c = dvec3(scene.vertex(triangle, 2)) - apex;
      const double value = glm::dot(a, glm::cross(b, c));
      own.back().part.value += value, own.back().part.size += std::abs(value);
    }
  });
  std::vector<SignedVolume> volumes(topology.components.size());
  for (const std::vector<Run>& part : runs)
    for (const Run& run : part)
      volumes[run.component].value += run.part.value, volumes[run.component].size += run.part.size;
  for (size_t i = 0; i < volumes.size(); ++i) {
    if (std::abs(volumes[i].value) <= kNoVolume * volumes[i].size) continue;
    topology.components[i].winding = volumes[i].value > 0 ? Winding::outward : Winding::inward;
    topology.components[i].volume = std::abs(volumes[i].value) / 6;
  }
}

}  // namespace

Topology build_topology(const Scene& scene, ThreadPool& pool) {
  const std::vector<uvec3> triangles = welded_triangles(scene, pool);
  Topology topology;
  build_edges(triangles, scene.positions.size(), pool, topology);

  topology.component_of_triangle.resize(triangles.size());
  for (uint32_t i = 0; i < triangles.size(); ++i) topology.component_of_triangle[i] = i;
  const std::vector<uint32_t> irregular = unite_at_edges(topology, pool);
  number_components(topology, triangles);
  count_irregular_edges(topology, irregular);
  measure_volumes(scene, pool, topology);
  return topology;
}

void drop_edges(Topology& topology) {
  topology.edges = {};
  topology.first_use = {};
  topology.uses = {};
}

size_t memory_bytes(const Topology& t) {
  return bytes_of(t.component_of_triangle) + bytes_of(t.components) + bytes_of(t.edges) + bytes_of(t.first_use) +
         bytes_of(t.uses);
}

}  // namespace hybridrt
