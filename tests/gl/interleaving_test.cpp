// Section 3.5 of the paper: the number of frames in flight and of threads changes no bit.

#include "tests/gl/frame_test.h"
#include "tests/gl/gl_test.h"

namespace hybridrt {
namespace {

constexpr const char* kScene = "scene:spheres,triangles=2000,reflective=30";

struct Mode {
  const char* name;
  Method method;
  ShadowMode shadows;
};

class Interleaving : public testing::TestWithParam<Mode> {
 protected:
  void SetUp() override {
    std::string why;
    if (!has_context({}, &why)) GTEST_SKIP() << why;
  }
};

TEST_P(Interleaving, SlotsAndThreadsChangeNoBit) {
  RenderJob job = orbit_job(kScene, 6);
  job.settings.method = GetParam().method;
  job.settings.shadows = GetParam().shadows;
  job.settings.aovs = kAovId | kAovShadow | kAovMarked | kAovTraced | kAovDepth | kAovNormal;
  job.settings.frames_in_flight = 1;
  const std::vector<Frame> expected = render_all(job);
  ASSERT_EQ(expected.size(), 6u);
  EXPECT_FALSE(expected[0].picture.data == expected[3].picture.data) << "the camera does not move";
  for (int threads : {1, 2, 5})
    for (int slots : {1, 2, 3}) {
      job.settings.frames_in_flight = slots;
      expect_same_frames(render_all(job, nullptr, threads), expected,
                         fmt::format("{} slots, {} threads", slots, threads));
    }
}

INSTANTIATE_TEST_SUITE_P(Modes, Interleaving,
                         testing::Values(Mode{"blur", Method::hybrid, ShadowMode::blur},
                                         Mode{"rays", Method::hybrid, ShadowMode::rays},
                                         Mode{"map", Method::hybrid, ShadowMode::map},
                                         Mode{"raster", Method::raster, ShadowMode::map}),
                         [](const auto& mode) { return mode.param.name; });

class FrameOrder : public GlTest {};

TEST_F(FrameOrder, MoreSlotsThanFramesAndNoFramesAtAll) {
  RenderJob job = orbit_job(kScene, 2, 32, 24);
  job.settings.frames_in_flight = 5;
  EXPECT_EQ(render_all(job).size(), 2u);
  int delivered = 0;
  ThreadPool pool(1);
  run(
      job, pool, [](const RunFacts&) {}, [] { return true; }, [&](Frame&&) { ++delivered; });
  EXPECT_EQ(delivered, 0) << "asked to stop before the first frame";
}

TEST_F(FrameOrder, FramesLeaveInTheOrderAskedFor) {
  RenderJob job = orbit_job(kScene, 40, 32, 24);
  job.frames.ranges = {{30, 40, 5}, {1, 3, 1}, {20, 20, 1}};
  for (int slots : {1, 2, 3}) {
    job.settings.frames_in_flight = slots;
    std::vector<int> numbers;
    for (const Frame& frame : render_all(job)) numbers.push_back(frame.number);
    EXPECT_EQ(numbers, (std::vector<int>{30, 35, 40, 1, 2, 3, 20}));
  }
}

// A part of a sequence gives the same pictures as the whole: farms rely on it.
TEST_F(FrameOrder, ShardsAreTheWholesFrames) {
  RenderJob job = orbit_job(kScene, 6, 64, 48);
  const std::vector<Frame> whole = render_all(job);
  job.frames.ranges = {{5, 5, 1}, {2, 2, 1}};
  const std::vector<Frame> part = render_all(job);
  ASSERT_EQ(part.size(), 2u);
  EXPECT_TRUE(part[0].picture.data == whole[4].picture.data);
  EXPECT_TRUE(part[1].picture.data == whole[1].picture.data);
}

// Frames in progress when a stop is requested are still delivered, complete.
TEST_F(FrameOrder, StoppingFinishesWhatWasBegun) {
  RenderJob job = orbit_job(kScene, 100, 32, 24);
  ThreadPool pool(2);
  for (int slots : {1, 3}) {
    job.settings.frames_in_flight = slots;
    int begun = 0, delivered = 0;
    run(
        job, pool, [](const RunFacts&) {}, [&] { return begun++ >= 4; },
        [&](Frame&& frame) { EXPECT_EQ(frame.number, ++delivered); });
    EXPECT_EQ(delivered, 4) << slots;
  }
}

TEST_F(FrameOrder, ADeliveryThatThrowsEndsTheRun) {
  RenderJob job = orbit_job(kScene, 100, 32, 24);
  job.settings.frames_in_flight = 3;
  ThreadPool pool(2);
  EXPECT_THROW(run(
                   job, pool, [](const RunFacts&) {}, [] { return false; },
                   [](Frame&&) { throw Error(ErrorKind::output, "the disk is full"); }),
               Error);
}

// A slot serves one frame after another: a frame must not report an earlier one's rays.
TEST_F(FrameOrder, AFrameReportsItsOwnRaysOnly) {
  RenderJob job = orbit_job("scene:spheres,triangles=2000,reflective=100", 4, 64, 48);
  job.settings.shadows = ShadowMode::map;
  job.repeats_still_frames = false;
  CameraPath path;
  const dvec3 eye(0, 4, 12);  // two frames see the mirrors, two turn away from them
  path.keys = {{2, {eye, {0, 0, 0}, {0, 1, 0}, 0.8}, {}}, {3, {eye, {0, 8, 24}, {0, 1, 0}, 0.8}, {}}};
  job.motion.course = path;
  for (int slots : {1, 2, 3}) {
    job.settings.frames_in_flight = slots;
    const std::vector<Frame> frames = render_all(job);
    ASSERT_EQ(frames.size(), 4u);
    for (const Frame& frame : frames) {
      const bool sees_mirrors = frame.number <= 2;
      EXPECT_EQ(frame.stats.reflection_rays > 0, sees_mirrors) << slots << " slots, frame " << frame.number;
      EXPECT_EQ(frame.timings[PassId::trace] > 0, sees_mirrors) << slots << " slots, frame " << frame.number;
    }
  }
}

}  // namespace
}  // namespace hybridrt
