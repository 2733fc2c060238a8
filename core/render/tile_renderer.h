#pragma once

#include "core/base/parallel.h"
#include "core/render/frame.h"
#include "core/trace/ray_caster.h"
#include "core/trace/sheets.h"

namespace hybridrt {

/// The paper's five passes over a sequence without any GL, for settings without shadow maps: a tile of the picture goes
/// through ids, shadow queries, rays and shading on one thread while its data is in the cache. The picture is the GL
/// form's, up to rounding; with method raytrace primary rays find what is seen, and all else is the same; where the
/// settings repair the GL form's ids, the ids are the same. `caster` may be null if !needs_caster(). All arguments must
/// outlive the call.
void render_tiles(const Scene& scene, const SceneFacts& facts, const Sheets& sheets, const RenderSettings& settings,
                  const RayCaster<float>* caster, ThreadPool& pool, const NextFrame& next, const DeliverFrame& deliver);

}  // namespace hybridrt
