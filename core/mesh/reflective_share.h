#pragma once

#include "core/mesh/topology.h"

namespace hybridrt {

/// Makes `percent` (0 to 100) of the triangles mirrors of reflectivity 0.5; Kd and Ks stay. Mirrors that the scene has
/// are unset first, so that 0 leaves none; glass stays glass unless it is chosen. What is chosen: whole components, and
/// of a component with more than 1 % of the triangles connected patches of at most that size, in the order of a fixed
/// shuffle. So a mirror stays one at a higher percentage, and 100 is everything. Must precede make_scene_facts().
void set_reflective_share(Scene& scene, const Topology& topology, double percent);

}  // namespace hybridrt
