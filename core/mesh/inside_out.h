#pragma once

#include "core/base/parallel.h"
#include "core/base/warnings.h"
#include "core/mesh/topology.h"

namespace hybridrt {

/// The closed components that are wound the wrong way, ascending. By nesting (nesting.h):
///  - an inward one within a body is a cavity, and right;
///  - one that is not, but holds other geometry, is a room, and right;
///  - one that holds nothing is inside out;
///  - so is one of refracting material, as nobody stands in glass; then what it holds of the same material, closed,
///  must
///    be its cavities, and what these hold bodies again (a bottle whose file is mirrored).
std::vector<uint32_t> find_inside_out(const Scene& scene, const Topology& topology, ThreadPool& pool);

/// Turns these components: reverses their triangles, and those of their normals that point the wrong way then. Normals
/// that other triangles use too are copied.
void turn_components(Scene& scene, Topology& topology, const std::vector<uint32_t>& components);

/// Turns what is inside out and warns, once.
void turn_inside_out_bodies(Scene& scene, Topology& topology, ThreadPool& pool, Warnings& warnings);

}  // namespace hybridrt
