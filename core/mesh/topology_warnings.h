#pragma once

#include "core/base/warnings.h"
#include "core/mesh/topology.h"
#include "core/scene/scene.h"

namespace hybridrt {

/// Warns of what only the topology shows: non-manifold edges, and refracting materials on open meshes.
void topology_warnings(const Scene& scene, const Topology& topology, Warnings& warnings);

}  // namespace hybridrt
