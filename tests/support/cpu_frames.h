#pragma once

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <stdexcept>

#include "core/render/default_view.h"
#include "core/render/render_job.h"
#include "tests/support/load_scene.h"

namespace hybridrt {

constexpr uint32_t kAllAovs = kAovId | kAovShadow | kAovMarked | kAovTraced | kAovDepth | kAovNormal;

/// A job on the CPU with all AOVs: 330x200 pixels, an orbit, two lights with shadows.
inline RenderJob cpu_job_of(Scene scene, int frames) {
  static ThreadPool pool(2);
  RenderJob job;
  Warnings warnings;
  set_scene(job, std::move(scene), pool, warnings);
  job.settings.width_px = 330, job.settings.height_px = 200;
  job.settings.forms = PassForms::cpu;
  job.settings.aovs = kAllAovs;
  job.frames = parse_frame_spec(fmt::format("1-{}", frames));
  job.motion.sequence = {1, frames, 1};
  job.motion.course = default_orbit(job.scene, job.scene.bounds, 1.65, kPi / 4);
  job.lights.lights = {{glm::normalize(dvec3(0.5, 0.9, 0.3))}, {glm::normalize(dvec3(-0.7, 0.5, 0.6)), vec3(0.4f)}};
  return job;
}

inline RenderJob cpu_job_of(const std::string& argument, int frames) {
  ThreadPool pool(2);
  Warnings warnings;
  return cpu_job_of(load_scene(argument, pool, warnings), frames);
}

/// Renders without any GL.
inline std::vector<Frame> frames_of(const RenderJob& job, int threads = 2) {
  ThreadPool pool(threads);
  std::vector<Frame> frames;
  run(
      job, pool, [](const RunFacts& facts) { EXPECT_FALSE(facts.gl); }, [] { return false; },
      [&](Frame&& frame) { frames.push_back(std::move(frame)); });
  return frames;
}

inline const ImageLayer& layer(const Frame& frame, const std::string& name) {
  for (const ImageLayer& aov : frame.aovs)
    if (aov.name == name) return aov;
  throw std::runtime_error("no AOV " + name);
}

}  // namespace hybridrt
