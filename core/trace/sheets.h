#pragma once

#include <cstdint>
#include <vector>

#include "core/base/parallel.h"
#include "core/mesh/topology.h"
#include "core/scene/scene.h"

namespace hybridrt {

/// How the scene's triangles continue one another, as far as shadows must know. 13 bytes per triangle.
struct Sheets {
  /// Per triangle: 1 if it belongs to a closed body wound outward, -1 if to one wound inward, else 0. A body with holes
  /// in any triangle is not closed.
  std::vector<int8_t> sides;

  /// Per triangle: [k] is the triangle across its side from corner k to corner k + 1. kNoTriangle, where a sheet may
  /// end, if there is not exactly one, if it goes the same way along the side (one of the two is wound the wrong way),
  /// or if one of the two has holes.
  std::vector<uvec3> across;
};

/// The result does not depend on the number of threads.
Sheets make_sheets(const Scene& scene, const Topology& topology, ThreadPool& pool);

/// Bytes of finished sheets.
size_t memory_bytes(const Sheets& sheets);

}  // namespace hybridrt
