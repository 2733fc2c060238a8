#pragma once

#include "cli/job.h"

namespace hybridrt::cli {

/// make_render_job(). If that takes more than a second, a line on standard error that redraws itself, and is gone in
/// the end, tells how far it is; none without a terminal or where `quiet`.
RenderJob load_showing_progress(const RenderOptions& options, const SceneSource& source, ThreadPool& pool,
                                Warnings& warnings, bool quiet);

}  // namespace hybridrt::cli
