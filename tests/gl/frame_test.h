#pragma once

#include <gtest/gtest.h>

#include "core/base/error.h"
#include "core/render/default_light.h"
#include "core/render/render_job.h"
#include "tests/support/load_scene.h"

namespace hybridrt {

/// A small orbit around `scene`, as `hybridrt render` would set it up.
inline RenderJob orbit_job(Scene scene, int frames, int width_px = 160, int height_px = 120) {
  RenderJob job;
  ThreadPool pool(1);
  Warnings warnings;
  set_scene(job, std::move(scene), pool, warnings);
  job.settings.width_px = width_px;
  job.settings.height_px = height_px;
  job.settings.shadow_map_px = 1024;
  job.frames.ranges = {{1, frames, 1}};
  job.motion.sequence = {1, frames, 1};
  job.motion.course = default_orbit(job.scene, job.scene.bounds, static_cast<double>(width_px) / height_px, 0.7);
  job.lights.lights = {default_light(Surroundings::outside, camera_at(job.motion, 1), job.settings.ambient)};
  job.shaders = gl::embedded_shaders();
  return job;
}

inline RenderJob orbit_job(const std::string& scene, int frames, int width_px = 160, int height_px = 120) {
  ThreadPool pool(1);
  Warnings warnings;
  return orbit_job(load_scene(scene, pool, warnings), frames, width_px, height_px);
}

inline std::vector<Frame> render_all(const RenderJob& job, RunFacts* facts = nullptr, int threads = 1) {
  std::vector<Frame> frames;
  ThreadPool pool(threads);
  const RunFacts found = run(
      job, pool, [](const RunFacts&) {}, [] { return false; },
      [&](Frame&& frame) { frames.push_back(std::move(frame)); });
  if (facts) *facts = found;
  return frames;
}

/// Whether the machine can open `request`; tests skip otherwise.
inline bool has_context(const gl::ContextRequest& request, std::string* why = nullptr) {
  try {
    gl::open_context(request);
    return true;
  } catch (const Error& unavailable) {
    if (why) *why = unavailable.what();
    return false;
  }
}

/// Expects equal bits of all pixels, AOVs included, and equal counts: they must not depend on how a frame was made.
inline void expect_same_frames(const std::vector<Frame>& a, const std::vector<Frame>& b, const std::string& what) {
  ASSERT_EQ(a.size(), b.size()) << what;
  for (size_t i = 0; i < a.size(); ++i) {
    EXPECT_EQ(a[i].number, b[i].number) << what;
    EXPECT_TRUE(a[i].picture.data == b[i].picture.data) << what << ", frame " << a[i].number;
    ASSERT_EQ(a[i].aovs.size(), b[i].aovs.size()) << what;
    for (size_t k = 0; k < a[i].aovs.size(); ++k) {
      EXPECT_EQ(a[i].aovs[k].name, b[i].aovs[k].name) << what;
      EXPECT_TRUE(a[i].aovs[k].values == b[i].aovs[k].values && a[i].aovs[k].numbers == b[i].aovs[k].numbers)
          << what << ", frame " << a[i].number << ", " << a[i].aovs[k].name;
    }
    const TraceStats &s = a[i].stats, &t = b[i].stats;
    EXPECT_EQ(s.pixels_hit, t.pixels_hit) << what;
    EXPECT_EQ(s.pixels_marked, t.pixels_marked) << what;
    EXPECT_EQ(s.pixels_reflective, t.pixels_reflective) << what;
    EXPECT_EQ(s.pixels_refractive, t.pixels_refractive) << what;
    EXPECT_EQ(s.shadow_rays, t.shadow_rays) << what;
    EXPECT_EQ(s.primary_shadow_rays, t.primary_shadow_rays) << what;
    EXPECT_EQ(s.reflection_rays, t.reflection_rays) << what;
    EXPECT_EQ(s.refraction_rays, t.refraction_rays) << what;
  }
}

}  // namespace hybridrt
