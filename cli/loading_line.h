#pragma once

#include "cli/job.h"

namespace hybridrt::cli {

/// Calls make_render_job(). If that takes more than a second, a line on standard error shows the progress; it redraws
/// itself and is erased at the end. There is none without a terminal or if `quiet`.
RenderJob load_showing_progress(const RenderOptions& options, const SceneSource& source, ThreadPool& pool,
                                Warnings& warnings, bool quiet);

}  // namespace hybridrt::cli
