#pragma once

#include <cstdint>
#include <vector>

#include "core/base/parallel.h"
#include "core/mesh/topology.h"
#include "core/scene/scene.h"

namespace hybridrt {

/// How the scene's triangles go on into one another, as far as shadows must know. 13 bytes a triangle.
struct Sheets {
  /// Of each triangle: 1 if it belongs to a closed body wound outward, -1 if to one wound inward, else 0. A body of
  /// which a triangle has holes is not closed.
  std::vector<int8_t> sides;

  /// Of each triangle: across its side from corner k to corner k + 1 lies the triangle [k]. kNoTriangle where not
  /// exactly one lies there, where it goes the same way along the side (one of the two is wound the wrong way), and
  /// where one of the two has holes: there a sheet may end.
  std::vector<uvec3> across;
};

/// The result does not depend on the number of threads.
Sheets make_sheets(const Scene& scene, const Topology& topology, ThreadPool& pool);

}  // namespace hybridrt
