// Frames with a shadow map on the CPU: against rays, and what must not change them.

#include "core/render/mapped_renderer.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "tests/support/cpu_frames.h"
#include "tests/support/textured_scenes.h"

namespace hybridrt {
namespace {

template <typename SceneOrName>
RenderJob job_of(const SceneOrName& scene, ShadowMode shadows, int frames = 1) {
  RenderJob job = cpu_job_of(scene, frames);
  job.settings.shadows = shadows;
  job.settings.shadow_map_px = 1024;
  return job;
}

constexpr const char* kSpheres = "scene:spheres,triangles=4000,reflective=30";

size_t differing(const std::vector<float>& a, const std::vector<float>& b) {
  size_t count = 0;
  for (size_t i = 0; i < a.size(); ++i) count += a[i] != b[i];
  return count;
}

// A map is wrong along shadows' edges; the blur finds most of that.
TEST(MappedRenderer, ShadowsAreNearlyThoseOfRays) {
  for (const Scene& scene : {textured_room(), [] {
                               ThreadPool pool(2);
                               Warnings warnings;
                               return load_scene(kSpheres, pool, warnings);
                             }()}) {
    RenderJob job = job_of(scene, ShadowMode::rays);
    job.settings.method = Method::reference;
    const Frame truth = frames_of(job).at(0);
    size_t wrong[2] = {};
    for (const bool blur : {false, true}) {
      const Frame frame = frames_of(job_of(scene, blur ? ShadowMode::blur : ShadowMode::map)).at(0);
      EXPECT_EQ(layer(frame, "id").numbers, layer(truth, "id").numbers);
      EXPECT_EQ(layer(frame, "depth").values, layer(truth, "depth").values);
      wrong[blur] = differing(layer(frame, "shadow").values, layer(truth, "shadow").values);
    }
    EXPECT_LT(wrong[0], 330 * 200 / 100);
    EXPECT_LT(10 * wrong[1], wrong[0]);
  }
}

TEST(MappedRenderer, ACropIsAPartOfTheWholeFrame) {
  for (const ShadowMode shadows : {ShadowMode::map, ShadowMode::blur})
    for (const ShadowWarp warp : {ShadowWarp::uniform, ShadowWarp::lispsm})
      for (const int samples : {1, 2}) {
        RenderJob job = job_of(kSpheres, shadows);
        job.settings.shadow_warp = warp, job.settings.samples = samples;
        const Frame whole = frames_of(job).at(0);
        const PixelRect crop{37, 21, 150, 99};
        job.settings.crop = crop;
        const Frame part = frames_of(job).at(0);
        ASSERT_EQ(part.picture.width_px, crop.width_px);
        for (int y = 0; y < crop.height_px; ++y)
          for (int i = 0; i < 3 * crop.width_px; ++i)
            ASSERT_EQ(
                part.picture.data[static_cast<size_t>(3 * crop.width_px * y + i)],
                whole.picture.data[static_cast<size_t>(3 * (whole.picture.width_px * (y + crop.y_px) + crop.x_px) + i)])
                << name_of(shadows) << ' ' << i << ' ' << y;
      }
}

TEST(MappedRenderer, ACropWithoutLightsThatCastShadows) {
  RenderJob job = job_of(kSpheres, ShadowMode::blur);
  for (DirectionalLight& light : job.lights.lights) light.casts_shadow = false;
  job.settings.crop = PixelRect{37, 21, 150, 99};
  EXPECT_EQ(frames_of(job).at(0).picture.pixel_count(), 150u * 99);
}

TEST(MappedRenderer, FramesAreTheSameForAnyNumberOfThreads) {
  for (const ShadowMode shadows : {ShadowMode::map, ShadowMode::blur}) {
    const RenderJob job = job_of(textured_room(), shadows, 2);
    const std::vector<Frame> one = frames_of(job, 1);
    for (int round = 0; round < 10; ++round) {
      const std::vector<Frame> many = frames_of(job, 2 + round % 3);
      for (size_t f = 0; f < one.size(); ++f) ASSERT_EQ(one[f].picture.data, many[f].picture.data) << round;
    }
  }
}

// A still light's map is kept, a warped one only while the camera stands still too.
TEST(MappedRenderer, MapsAreKept) {
  for (const ShadowWarp warp : {ShadowWarp::uniform, ShadowWarp::lispsm}) {
    RenderJob job = job_of(kSpheres, ShadowMode::map, 3);
    job.settings.shadow_warp = warp, job.settings.reflection_depth = 0;
    const std::vector<Frame> moving = frames_of(job);
    for (size_t f = 1; f < moving.size(); ++f)
      EXPECT_EQ(moving[f].timings[PassId::shadow_map] > 0, warp == ShadowWarp::lispsm);
    job.motion.course = camera_at(job.motion, 2);
    const std::vector<Frame> still = frames_of(job);
    for (size_t f = 0; f < still.size(); ++f) {
      EXPECT_EQ(still[f].timings[PassId::shadow_map] > 0, f == 0);
      EXPECT_EQ(still[f].picture.data, moving[1].picture.data) << f;
    }
  }
}

// Nothing is kept that a light which moves has left behind.
TEST(MappedRenderer, MapsFollowTheLight) {
  RenderJob job = job_of(kSpheres, ShadowMode::blur, 3);
  job.lights.mode = LightMode::with_camera;
  const std::vector<Frame> all = frames_of(job);
  for (int f = 1; f <= 3; ++f) {
    job.frames.ranges = {{f, f, 1}};
    EXPECT_EQ(frames_of(job).at(0).picture.data, all[static_cast<size_t>(f) - 1].picture.data) << f;
  }
}

TEST(MappedRenderer, AlphaIsCoverage) {
  RenderJob job = job_of(kSpheres, ShadowMode::map);
  job.settings.alpha = true;
  const Frame frame = frames_of(job).at(0);
  ASSERT_EQ(frame.picture.channels, 4);
  const ImageLayer& ids = layer(frame, "id");
  for (size_t i = 0; i < ids.numbers.size(); ++i)
    ASSERT_EQ(frame.picture.data[4 * i + 3], ids.numbers[i] == kNoTriangle ? 0 : 1);
}

TEST(MappedRenderer, NothingInView) {
  RenderJob job = job_of(kSpheres, ShadowMode::blur);
  Camera away = camera_at(job.motion, 1);
  away.eye_world.y += 100;
  away.target_world = away.eye_world + dvec3(0, 1, 0);
  away.up = {1, 0, 0};
  job.motion.course = away;
  EXPECT_EQ(frames_of(job).at(0).stats.pixels_hit, 0);
}

}  // namespace
}  // namespace hybridrt
