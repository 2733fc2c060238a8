#pragma once

#include <vector>

#include "core/render/render_job.h"

namespace hybridrt::cli {

/// How far each triangle of the job's scene may move, in scene units, so that none of its frames shows it move by more
/// than `max_error_px` pixels (view_bounds.h). Fewer frames count if a signal asks to stop.
std::vector<float> bounds_on_path(const RenderJob& job, double max_error_px, ThreadPool& pool);

}  // namespace hybridrt::cli
