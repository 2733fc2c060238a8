// Several lights through every method: light adds up, shadows and all.

#include "tests/gl/frame_test.h"
#include "tests/support/trace_scenes.h"

namespace hybridrt {
namespace {

constexpr int kWidth_px = 160, kHeight_px = 120;
// Sums of a few floats around 1, in another order.
constexpr float kRounding = 2e-6f;

struct Mode {
  Method method;
  ShadowMode shadows;
};

std::string name_of_mode(const testing::TestParamInfo<Mode>& mode) {
  return std::string(name_of(mode.param.method)) + "_" + std::string(name_of(mode.param.shadows));
}

const std::vector<float>& layer(const Frame& frame, std::string_view name) {
  for (const ImageLayer& aov : frame.aovs)
    if (aov.name == name) return aov.values;
  throw std::logic_error("no such layer");
}

class SeveralLights : public testing::TestWithParam<Mode> {
 protected:
  void SetUp() override {
    std::string why;
    if (!has_context({}, &why)) GTEST_SKIP() << why;
    job_.settings.method = GetParam().method;
    job_.settings.shadows = GetParam().shadows;
    job_.settings.shadow_map_px = 256;
    job_.settings.aovs = kAovShadow | kAovMarked;
  }

  Frame with(const std::vector<DirectionalLight>& lights) {
    job_.lights.lights = lights;
    return std::move(render_all(job_).front());
  }

  RenderJob job_ = orbit_job("scene:spheres,triangles=2000,reflective=30", 1, kWidth_px, kHeight_px);
};

TEST_P(SeveralLights, AddUpWhatEachGivesAlone) {
  const Frame dark = with({});
  for (uint32_t seed = 1; seed <= 3; ++seed) {
    Random random(seed);
    std::vector<DirectionalLight> lights;
    for (size_t i = 0; i < seed + 1; ++i)
      lights.push_back({glm::normalize(dvec3(random.direction()) + dvec3(0, 0.5, 0)), random.in_cube(0, 0.5f),
                        /*casts_shadow=*/i != 1 || seed != 2});
    const Frame together = with(lights);
    std::vector<Frame> alone;
    for (const DirectionalLight& light : lights) alone.push_back(with({light}));
    float worst = 0, brightest = 0;
    for (size_t i = 0; i < dark.picture.data.size(); ++i) {
      double sum = dark.picture.data[i];
      for (const Frame& frame : alone) sum += double(frame.picture.data[i]) - dark.picture.data[i];
      worst = std::max(worst, std::abs(together.picture.data[i] - static_cast<float>(sum)));
      brightest = std::max(brightest, together.picture.data[i] - dark.picture.data[i]);
    }
    EXPECT_LE(worst, kRounding);
    EXPECT_GT(brightest, 0.3f);

    int64_t marked = 0, shadow_rays = 0;
    for (const Frame& frame : alone) marked += frame.stats.pixels_marked, shadow_rays += frame.stats.shadow_rays;
    EXPECT_EQ(together.stats.pixels_marked, marked);
    EXPECT_EQ(together.stats.shadow_rays, shadow_rays);
  }
}

// AOV shadow: the share of the lights that arrive; marked: whether any light asks.
TEST_P(SeveralLights, LayersTellOfAllLights) {
  const std::vector<DirectionalLight> lights = {{glm::normalize(dvec3(1, 1, 0.2)), vec3(0.5f)},
                                                {glm::normalize(dvec3(-0.3, 1, 1)), vec3(0.4f)}};
  const Frame together = with(lights), first = with({lights[0]}), second = with({lights[1]});
  int half = 0;
  for (size_t i = 0; i < together.picture.pixel_count(); ++i) {
    ASSERT_EQ(layer(together, "shadow")[i], 0.5f * (layer(first, "shadow")[i] + layer(second, "shadow")[i])) << i;
    ASSERT_EQ(layer(together, "marked")[i], std::max(layer(first, "marked")[i], layer(second, "marked")[i])) << i;
    half += layer(together, "shadow")[i] == 0.5f;
  }
  if (GetParam().shadows != ShadowMode::none) {
    EXPECT_GT(half, 100);
  }
}

// The first light moves by keys, two others stand still: each frame is the same as alone, whatever is in flight.
TEST_P(SeveralLights, FramesInFlightAndKeptStructuresChangeNoBit) {
  CameraPath path;
  for (int i = 0; i < 3; ++i)
    path.keys.push_back({1.0 + 2 * i, camera_at(job_.motion, 1), glm::normalize(dvec3(1 - i, 1, 0.3 * i))});
  job_.motion = {path, {1, 5, 1}};
  job_.frames.ranges = {{1, 5, 1}};
  job_.lights.mode = LightMode::with_path;
  job_.lights.lights = {{glm::normalize(dvec3(1, 1, 0)), vec3(0.4f)},
                        {glm::normalize(dvec3(-0.3, 1, 1)), vec3(0.3f)},
                        {glm::normalize(dvec3(0.2, 0.4, -1)), vec3(0.3f, 0.2f, 0.1f)}};
  job_.settings.frames_in_flight = 1;
  const std::vector<Frame> expected = render_all(job_, nullptr, 2);
  EXPECT_FALSE(expected[0].picture.data == expected[4].picture.data) << "the light does not move";
  for (int slots : {2, 3}) {
    job_.settings.frames_in_flight = slots;
    expect_same_frames(render_all(job_, nullptr, 2), expected, fmt::format("{} slots", slots));
  }
  for (const int frame : {4, 2}) {
    job_.frames.ranges = {{frame, frame, 1}};
    EXPECT_TRUE(render_all(job_, nullptr, 2).front().picture.data == expected[frame - 1].picture.data) << frame;
  }
}

TEST_P(SeveralLights, MapsAndBuffersAreKeptWhileTheyStandStill) {
  job_.motion.sequence = {1, 3, 1};
  job_.frames.ranges = {{1, 3, 1}};
  job_.lights.lights = {{glm::normalize(dvec3(1, 1, 0)), vec3(0.4f)},
                        {glm::normalize(dvec3(-0.3, 1, 1)), vec3(0.3f)},
                        {glm::normalize(dvec3(0.2, 0.4, -1)), vec3(0.3f)}};
  const bool has_structures = GetParam().shadows != ShadowMode::none && GetParam().method != Method::reference;
  const auto expect_kept = [&] {
    const std::vector<Frame> frames = render_all(job_);
    EXPECT_EQ(frames[0].timings[PassId::shadow_map] > 0, has_structures);
    for (const int later : {1, 2}) EXPECT_EQ(frames[later].timings[PassId::shadow_map], 0) << later;
  };
  job_.settings.shadow_warp = ShadowWarp::uniform;
  expect_kept();
  job_.settings.shadow_warp = ShadowWarp::lispsm;  // fitted to what the camera sees
  job_.motion.course = camera_at(job_.motion, 1);
  expect_kept();
}

INSTANTIATE_TEST_SUITE_P(
    Modes, SeveralLights,
    testing::Values(Mode{Method::hybrid, ShadowMode::none}, Mode{Method::hybrid, ShadowMode::map},
                    Mode{Method::hybrid, ShadowMode::blur}, Mode{Method::hybrid, ShadowMode::exact},
                    Mode{Method::hybrid, ShadowMode::rays}, Mode{Method::raster, ShadowMode::none},
                    Mode{Method::raster, ShadowMode::map}, Mode{Method::raytrace, ShadowMode::none},
                    Mode{Method::raytrace, ShadowMode::rays}, Mode{Method::reference, ShadowMode::none},
                    Mode{Method::reference, ShadowMode::rays}),
    name_of_mode);

}  // namespace
}  // namespace hybridrt
