#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/scene/scene.h"

namespace hybridrt {

enum class Side : uint8_t {
  outside,
  inside,
  unclear,  ///< on the surface, or rays disagree
};

/// Where points in scene space lie with respect to a closed surface, whichever way it is wound: the triangles of
/// `scene` with these indices. Five fixed rays a point count how often the surface is crossed outward and inward; four
/// of them must agree. All points go through the triangles together, found by a grid across the rays, so that many
/// points cost little more than one.
std::vector<Side> sides_of(std::span<const dvec3> points, const Scene& scene, std::span<const uint32_t> triangles);

}  // namespace hybridrt
