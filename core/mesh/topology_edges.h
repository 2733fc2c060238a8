#pragma once

#include <span>

#include "core/base/parallel.h"
#include "core/mesh/topology.h"

namespace hybridrt {

/// Whether welding left a triangle with fewer than three corners.
inline bool is_degenerate(const uvec3& welded) {
  return welded.x == welded.y || welded.y == welded.z || welded.z == welded.x;
}

/// Fills `edges`, `first_use` and `uses` of `topology` from triangles whose corners are welded vertices,
/// each less than `vertices`. Sides of triangles are filed under their smaller vertex, then sorted there: one
/// scatter and many small sorts, all in parallel. The result does not depend on the number of threads.
void build_edges(std::span<const uvec3> welded_triangles, size_t vertices, ThreadPool& pool, Topology& topology);

}  // namespace hybridrt
