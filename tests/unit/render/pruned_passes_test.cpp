// What a frame leaves out (docs/method.md): it does not run, and no pixel changes by it.

#include <cmath>
#include <gtest/gtest.h>

#include "core/procedural/spheres.h"
#include "core/render/render_job.h"
#include "core/render/samples.h"

namespace hybridrt {
namespace {

/// Balls, a tenth of them mirrors, before an orbit of some frames, without any GL.
RenderJob orbit_job(ThreadPool& pool, int frames, double reflective_percent = 10) {
  RenderJob job;
  Warnings warnings;
  set_scene(job, make_spheres({2000, reflective_percent}), pool, warnings);
  job.settings.forms = PassForms::cpu;
  job.settings.width_px = 96, job.settings.height_px = 72;
  job.frames.ranges = {{1, frames, 1}};
  job.motion.sequence = {1, frames, 1};
  Orbit orbit;
  orbit.radius = 12, orbit.height = 5;
  job.motion.course = orbit;
  job.lights.lights = {DirectionalLight{glm::normalize(dvec3(1, 2, 1))}};
  return job;
}

struct Rendered {
  std::vector<Frame> frames;
  RunFacts facts;
};

Rendered render(const RenderJob& job, ThreadPool& pool) {
  Rendered result;
  result.facts = run(
      job, pool, [](const RunFacts&) {}, [] { return false; },
      [&](Frame&& frame) { result.frames.push_back(std::move(frame)); });
  return result;
}

TEST(PrunedPasses, AMirrorOutOfView) {
  ThreadPool pool(2);
  RenderJob job = orbit_job(pool, 1, 2);
  RenderJob matt = job;
  for (Material& material : matt.scene.materials) material.reflect = vec3(0), material.fresnel = Fresnel::none;
  matt.facts = make_scene_facts(matt.scene);
  int views = 0;
  for (int step = 0; step < 32; ++step) {  // looks around from above the middle
    const double turn = 2 * kPi * step / 32;
    job.motion.course = Camera{{0, 1, 0}, {std::cos(turn), 0, std::sin(turn)}, {0, 1, 0}, 0.5};
    if (make_frame_plan(job.scene, job.facts, frame_request(job, 1), job.settings).trace_scattered) continue;
    matt.motion = job.motion;
    const Rendered with = render(job, pool), without = render(matt, pool);
    EXPECT_EQ(with.frames[0].stats.reflection_rays, 0);
    EXPECT_EQ(with.frames[0].picture.data, without.frames[0].picture.data);
    views += with.frames[0].stats.pixels_hit > 1000;
  }
  EXPECT_GT(views, 3);
  EXPECT_LT(views, 32);
}

TEST(PrunedPasses, NoMirrorsNoCaster) {
  ThreadPool pool(2);
  EXPECT_FALSE(render(orbit_job(pool, 1), pool).facts.accel.empty());
  const RenderJob matt = orbit_job(pool, 1, 0);
  const Rendered pruned = render(matt, pool);
  EXPECT_TRUE(pruned.facts.accel.empty());
  RenderJob deep = matt;
  deep.settings.reflection_depth = 0;
  EXPECT_EQ(pruned.frames[0].picture.data, render(deep, pool).frames[0].picture.data);
}

TEST(PrunedPasses, AStillLightKeepsItsBuffer) {
  ThreadPool pool(2);
  const RenderJob job = orbit_job(pool, 3);
  const Rendered sequence = render(job, pool);
  EXPECT_GT(sequence.frames[0].timings[PassId::shadow_map], 0);
  for (int frame = 1; frame <= 3; ++frame) {
    const Frame& kept = sequence.frames[frame - 1];
    if (frame > 1) {
      EXPECT_EQ(kept.timings[PassId::shadow_map], 0);
    }
    RenderJob alone = job;
    alone.frames.ranges = {{frame, frame, 1}};
    EXPECT_EQ(kept.picture.data, render(alone, pool).frames[0].picture.data) << frame;
  }
}

TEST(PrunedPasses, AnEmptyViewAsksNothing) {
  ThreadPool pool(2);
  RenderJob job = orbit_job(pool, 1);
  job.motion.course = Camera{{0, 60, 0}, {0, 120, 1}, {0, 0, 1}, 0.6};
  const Rendered sky = render(job, pool);
  const TraceStats& stats = sky.frames[0].stats;
  EXPECT_EQ(stats.pixels_hit + stats.shadow_rays + stats.reflection_rays + stats.pixels_marked, 0);
  for (size_t i = 0; i < sky.frames[0].picture.data.size(); ++i)
    ASSERT_EQ(sky.frames[0].picture.data[i], job.settings.background[static_cast<int>(i % 3)]);
}

TEST(PrunedPasses, StillFramesAreTheSameAsRenderedOnes) {
  ThreadPool pool(2);
  RenderJob job = orbit_job(pool, 3);
  job.motion.course = Camera{{5, 6, 9}, {0, 0, 0}, {0, 1, 0}, 0.8};
  job.settings.samples = 2;
  const Rendered repeated = render(job, pool);
  job.repeats_still_frames = false;
  const Rendered rendered = render(job, pool);
  ASSERT_EQ(repeated.frames.size(), 3u);
  for (int i = 0; i < 3; ++i) {
    EXPECT_EQ(repeated.frames[i].repeated, i > 0);
    EXPECT_FALSE(rendered.frames[i].repeated);
    EXPECT_EQ(repeated.frames[i].number, rendered.frames[i].number);
    EXPECT_EQ(repeated.frames[i].picture.data, rendered.frames[i].picture.data);
  }
}

}  // namespace
}  // namespace hybridrt
