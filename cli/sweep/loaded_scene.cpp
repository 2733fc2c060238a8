#include "cli/sweep/loaded_scene.h"

#include "cli/interrupt.h"
#include "core/base/timing.h"

namespace hybridrt::cli {
namespace {

bool needs_float_caster(const RenderJob& job) {
  switch (job.settings.method) {
    case Method::reference: return false;
    case Method::raytrace: return true;
    case Method::hybrid:
    case Method::raster: return needs_caster(job.facts, job.settings, lights_move(job.lights, job.motion));
  }
  return true;
}

}  // namespace

LoadedScene load_scene_of(const SweepSetting& setting, ThreadPool& pool, Warnings& warnings) {
  LoadedScene scene;
  const Stopwatch loading;
  scene.job.repeats_still_frames = false;  // every frame is measured
  set_settings(scene.job, setting.options, *setting.source, warnings);
  scene.framing = set_loaded_scene(scene.job, setting.options, *setting.source, pool, warnings);
  scene.load_ms = loading.elapsed_ms();
  return scene;
}

void set_job(LoadedScene& scene, const SweepSetting& setting, ThreadPool& pool, Warnings& warnings) {
  RenderJob& job = scene.job;
  set_settings(job, setting.options, *setting.source, warnings);
  const Accel accel = job.settings.accel;
  job.caster = scene.casters[accel];
  set_camera_and_lights(job, setting.options, *setting.source, scene.framing, pool, warnings);
  if (!job.caster.caster && needs_float_caster(job)) job.caster = make_scene_caster(job.scene, accel, pool);
  scene.casters[accel] = job.caster;
}

std::vector<Frame> render_frames(RenderJob& job, const RenderSettings& settings, ThreadPool& pool) {
  const KeptJob kept{job};
  job.settings = settings;
  std::vector<Frame> frames;
  run(
      job, pool, [](const RunFacts&) {}, stop_requested, [&](Frame&& frame) { frames.push_back(std::move(frame)); });
  return frames;
}

}  // namespace hybridrt::cli
