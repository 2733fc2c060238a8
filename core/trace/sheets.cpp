#include "core/trace/sheets.h"

#include "core/base/memory.h"

namespace hybridrt {
namespace {

constexpr size_t kGrain = 1 << 14;

std::vector<int8_t> sides_of(const Scene& scene, const Topology& topology) {
  std::vector<bool> open(topology.components.size());
  for (size_t i = 0; i < open.size(); ++i) open[i] = !topology.components[i].closed();
  for (uint32_t i = 0; i < scene.triangle_count(); ++i)
    if (scene.has_holes(i)) open[topology.component_of_triangle[i]] = true;

  std::vector<int8_t> sides(topology.component_of_triangle.size());
  for (size_t i = 0; i < sides.size(); ++i) {
    const Component& component = topology.component_of(static_cast<uint32_t>(i));
    if (!open[topology.component_of_triangle[i]])
      sides[i] = component.winding == Winding::outward ? 1 : component.winding == Winding::inward ? -1 : 0;
  }
  return sides;
}

}  // namespace

Sheets make_sheets(const Scene& scene, const Topology& topology, ThreadPool& pool) {
  Sheets sheets{sides_of(scene, topology), {scene.triangle_count(), uvec3(kNoTriangle)}};
  parallel_for(pool, topology.edges.size(), kGrain, [&](size_t begin, size_t end) {
    for (size_t edge = begin; edge < end; ++edge) {
      if (topology.kind_of(edge) != EdgeKind::regular) continue;
      const std::span<const EdgeUse> uses = topology.uses_of(edge);
      if (scene.has_holes(uses[0].triangle) || scene.has_holes(uses[1].triangle)) continue;
      // Welding compares positions, so comparing them again finds the edge's corners.
      const vec3 ends[2] = {scene.positions[topology.edges[edge].a], scene.positions[topology.edges[edge].b]};
      for (int i = 0; i < 2; ++i)
        for (int k = 0; k < 3; ++k)
          if (scene.vertex(uses[i].triangle, k) == ends[uses[i].reversed])
            sheets.across[uses[i].triangle][k] = uses[1 - i].triangle;
    }
  });
  return sheets;
}

size_t memory_bytes(const Sheets& sheets) { return bytes_of(sheets.sides) + bytes_of(sheets.across); }

}  // namespace hybridrt
