#pragma once

#include "core/base/warnings.h"
#include "core/mesh/topology.h"
#include "core/scene/scene.h"

namespace hybridrt {

/// Whether some material bends light, so that it matters which side of a surface is inside. See-through materials that
/// do not bend it (Ni 1) do not count.
bool refracts(const Scene& scene);

/// Warns of what only the topology shows: non-manifold edges, and refracting materials on open meshes.
void topology_warnings(const Scene& scene, const Topology& topology, Warnings& warnings);

}  // namespace hybridrt
