#pragma once

#include "core/base/parallel.h"
#include "core/render/frame.h"
#include "core/trace/ray_caster.h"
#include "core/trace/sheets.h"

namespace hybridrt {

/// The paper's five passes over a sequence without any GL, for the shadow modes with a shadow map, `map` and `blur`.
/// Such a map is fitted to what the whole frame sees, and the blur looks at neighbours: so passes follow one another,
/// each over the whole frame, as in the GL form. The picture is the GL form's, but where that snaps vertices aside.
/// Arguments as those of render_tiles().
void render_mapped(const Scene& scene, const SceneFacts& facts, const Sheets& sheets, const RenderSettings& settings,
                   const RayCaster<float>* caster, ThreadPool& pool, const NextFrame& next,
                   const DeliverFrame& deliver);

}  // namespace hybridrt
