#pragma once

#include <cstdint>
#include <vector>

#include "core/base/parallel.h"
#include "core/mesh/topology.h"

namespace hybridrt {

/// What lies inside the closed components of a scene.
struct Nesting {
  std::vector<Aabb> boxes;                       ///< of each component, scene space
  std::vector<std::vector<uint32_t>> contents;   ///< of each component: those that are wholly inside, ascending
  std::vector<std::vector<uint32_t>> enclosers;  ///< of each component: those that it is a content of, ascending
};

/// Finds the contents of inward components, and the closed enclosers of these; other lists stay empty, since only
/// inward components may be inside out. A component is inside if no sample of it is outside and one is inside: what
/// stands on a floor is in the room, what sticks out of a wall is not. Boxes choose the pairs to look at
/// (point_in_body.h).
Nesting find_nesting(const Scene& scene, const Topology& topology, ThreadPool& pool);

}  // namespace hybridrt
