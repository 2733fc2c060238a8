#pragma once

#include "core/base/parallel.h"
#include "core/mesh/topology.h"
#include "core/render/frame.h"
#include "core/trace/ray_caster.h"

namespace hybridrt {

/// Methods raytrace (Real = float) and reference (Real = double): every generation on the CPU, no GL.
template <typename Real>
void render_on_cpu(const Scene& scene, const SceneFacts& facts, const Topology& topology,
                   const RenderSettings& settings, const RayCaster<Real>& caster, ThreadPool& pool,
                   const NextFrame& next, const DeliverFrame& deliver);

}  // namespace hybridrt
