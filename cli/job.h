#pragma once

#include "cli/render_options.h"
#include "core/base/parallel.h"
#include "core/base/warnings.h"
#include "core/load/load_watch.h"
#include "core/render/render_job.h"

namespace hybridrt::cli {

/// The threads of a run: ours, and as many that a software GL may start.
int thread_count(const RenderOptions& options);

/// Reads the scene and turns the options, as with_scene_settings() has them, into a job. Throws Error(usage) for
/// options that cannot be, Error(input) for the scene. `progress` is told how far reading it is.
RenderJob make_render_job(const RenderOptions& options, const SceneSource& source, ThreadPool& pool, Warnings& warnings,
                          LoadProgress* progress = nullptr);

}  // namespace hybridrt::cli
