#pragma once

#include "cli/render_options.h"
#include "core/base/parallel.h"
#include "core/base/warnings.h"
#include "core/load/load_watch.h"
#include "core/render/render_job.h"

namespace hybridrt::cli {

/// The number of threads of a run; a software GL may start as many of its own.
int thread_count(const RenderOptions& options);

/// Reads the scene and turns it and the options of with_scene_settings() into a job. Throws Error(usage) for impossible
/// options, Error(input) for the scene. `progress` follows the reading.
RenderJob make_render_job(const RenderOptions& options, const SceneSource& source, ThreadPool& pool, Warnings& warnings,
                          LoadProgress* progress = nullptr);

}  // namespace hybridrt::cli
