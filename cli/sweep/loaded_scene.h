#pragma once

#include <map>

#include "cli/job.h"
#include "cli/sweep/axes.h"

namespace hybridrt::cli {

/// A scene of a sweep, loaded once, with what is built for it once. `job` is set for one setting after the other.
struct LoadedScene {
  RenderJob job;
  Framing framing;
  double load_ms = 0;
  uint64_t making_peak_bytes = 0;  ///< of memory while it was loaded and its structures were built; 0: not measured
  std::map<Accel, SceneCaster<float>> casters;  ///< those that were needed
};

/// Throws as make_render_job().
LoadedScene load_scene_of(const SweepSetting& setting, ThreadPool& pool, Warnings& warnings);

/// Makes `scene.job` the setting's, with its structure for rays if any frame may need one. Throws as make_render_job().
void set_job(LoadedScene& scene, const SweepSetting& setting, ThreadPool& pool, Warnings& warnings);

/// Gives a job its settings and frames back.
struct KeptJob {
  RenderJob& job;
  RenderSettings settings = job.settings;
  FrameSpec frames = job.frames;
  ~KeptJob() {
    job.settings = settings;
    job.frames = frames;
  }
};

/// Renders the frames of `job` with other settings; fewer if a signal asks to stop.
std::vector<Frame> render_frames(RenderJob& job, const RenderSettings& settings, ThreadPool& pool);

}  // namespace hybridrt::cli
