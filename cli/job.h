#pragma once

#include "cli/render_options.h"
#include "core/base/parallel.h"
#include "core/base/warnings.h"
#include "core/load/load_watch.h"
#include "core/render/render_job.h"
#include "core/scene/framing.h"

namespace hybridrt::cli {

/// The number of threads of a run; a software GL may start as many of its own.
int thread_count(const RenderOptions& options);

/// Reads the scene and turns it and the options of with_scene_settings() into a job. Throws Error(usage) for impossible
/// options, Error(input) for the scene. `progress` follows the reading.
RenderJob make_render_job(const RenderOptions& options, const SceneSource& source, ThreadPool& pool, Warnings& warnings,
                          LoadProgress* progress = nullptr);

// Its three steps, for those who make several jobs of one scene.

/// Settings, frames, forms of the passes, memory limit.
void set_settings(RenderJob& job, const RenderOptions& options, const SceneSource& source, Warnings& warnings);

/// The scene, after set_settings(); returns what the default camera frames.
Framing set_loaded_scene(RenderJob& job, const RenderOptions& options, const SceneSource& source, ThreadPool& pool,
                         Warnings& warnings, LoadProgress* progress = nullptr);

/// What decides the scene of set_loaded_scene(): options with equal keys can share it.
std::string scene_key(const RenderOptions& options);

/// Camera, lights and the ambient light, after the other two. Uses job.caster, or sets it if it must build one.
void set_camera_and_lights(RenderJob& job, const RenderOptions& options, const SceneSource& source,
                           const Framing& framing, ThreadPool& pool, Warnings& warnings);

}  // namespace hybridrt::cli
