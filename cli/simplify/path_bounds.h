#pragma once

#include <vector>

#include "core/render/render_job.h"
#include "core/simplify/view_bounds.h"

namespace hybridrt::cli {

/// What a frame of the job is seen from, with the lights whose shadows are drawn; the whole frame, whatever the crop.
Sight sight_of(const RenderJob& job, int frame);

/// How far each triangle of the job's scene may move, in scene units, so that none of its frames shows it move by more
/// than `max_error_px` pixels (view_bounds.h). Fewer frames count if a signal asks to stop.
std::vector<float> bounds_on_path(const RenderJob& job, double max_error_px, ThreadPool& pool);

}  // namespace hybridrt::cli
