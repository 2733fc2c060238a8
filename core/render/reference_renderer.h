#pragma once

#include "core/base/parallel.h"
#include "core/render/frame.h"
#include "core/trace/ray_caster.h"
#include "core/trace/sheets.h"

namespace hybridrt {

/// Method reference: every generation on the CPU in double precision, no GL.
void render_reference(const Scene& scene, const SceneFacts& facts, const Sheets& sheets, const RenderSettings& settings,
                      const RayCaster<double>& caster, ThreadPool& pool, const NextFrame& next,
                      const DeliverFrame& deliver);

}  // namespace hybridrt
