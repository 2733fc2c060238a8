// A still light's shadow map is kept, a warped one only while the camera stands still too; else it is drawn anew.

#include "core/render/gl_renderer.h"
#include "core/render/samples.h"
#include "core/trace/embree_caster.h"
#include "tests/gl/frame_test.h"
#include "tests/gl/gl_test.h"

namespace hybridrt {
namespace {

class KeptShadowMap : public GlTest {
 protected:
  std::vector<Frame> render_lights(const std::vector<dvec3>& lights, int slots) {
    return render_frames(lights, std::vector<int>(lights.size(), 1), slots);
  }

  /// `places`: the camera's places on the orbit.
  std::vector<Frame> render_frames(const std::vector<dvec3>& lights, const std::vector<int>& places, int slots) {
    std::vector<FrameRequest> requests;
    for (size_t i = 0; i < lights.size(); ++i) requests.push_back(request_of(lights[i], places[i]));
    return render_requests(requests, slots);
  }

  FrameRequest request_of(const dvec3& light, int place) const {
    return {1, camera_at(job_.motion, place), {{glm::normalize(light), vec3(1)}}};
  }

  std::vector<Frame> render_requests(const std::vector<FrameRequest>& requests, int slots) {
    RenderSettings settings = job_.settings;
    settings.frames_in_flight = slots;
    const auto caster = make_embree_caster(job_.scene, 1);
    ThreadPool pool(2);
    GlRenderer renderer(context(), gl::embedded_shaders(), job_.scene, job_.facts, job_.sheets, settings, 1,
                        caster.get(), pool);
    size_t begun = 0;
    std::vector<Frame> frames;
    renderer.render(
        [&]() -> std::optional<FrameRequest> {
          return begun < requests.size() ? std::optional(requests[begun++]) : std::nullopt;
        },
        [&](Frame&& frame) { frames.push_back(std::move(frame)); });
    return frames;
  }

  RenderJob job_ = [] {
    RenderJob job = orbit_job("scene:spheres,triangles=2000,reflective=0", 6);
    job.settings.shadows = ShadowMode::map;
    return job;
  }();
  const dvec3 left_{-1, 1, 0.3}, right_{1, 1, 0.3};
};

TEST_F(KeptShadowMap, IsDrawnOnceForAStillLight) {
  for (int slots : {1, 2, 3}) {
    const std::vector<Frame> frames = render_lights({left_, left_, left_, left_}, slots);
    EXPECT_GT(frames[0].timings[PassId::shadow_map], 0);
    for (size_t i = 1; i < frames.size(); ++i) {
      EXPECT_EQ(frames[i].timings[PassId::shadow_map], 0) << "frame " << i + 1;
      EXPECT_TRUE(frames[i].picture.data == frames[0].picture.data);
    }
  }
}

TEST_F(KeptShadowMap, FollowsALightThatMoves) {
  const Frame alone_left = std::move(render_lights({left_}, 1)[0]);
  const Frame alone_right = std::move(render_lights({right_}, 1)[0]);
  EXPECT_FALSE(alone_left.picture.data == alone_right.picture.data);
  for (int slots : {1, 2, 3}) {
    const std::vector<Frame> frames = render_lights({left_, right_, right_, left_}, slots);
    EXPECT_TRUE(frames[0].picture.data == alone_left.picture.data) << slots;
    EXPECT_TRUE(frames[1].picture.data == alone_right.picture.data) << slots;
    EXPECT_TRUE(frames[2].picture.data == alone_right.picture.data) << slots;
    EXPECT_TRUE(frames[3].picture.data == alone_left.picture.data) << slots;
    EXPECT_GT(frames[1].timings[PassId::shadow_map], 0);
    EXPECT_EQ(frames[2].timings[PassId::shadow_map], 0);
    EXPECT_GT(frames[3].timings[PassId::shadow_map], 0);
  }
}

TEST_F(KeptShadowMap, FollowsACameraThatMovesIfWarped) {
  for (ShadowWarp warp : {ShadowWarp::uniform, ShadowWarp::lispsm}) {
    job_.settings.shadow_warp = warp;
    const bool warped = warp == ShadowWarp::lispsm;
    const Frame alone = std::move(render_frames({left_}, {2}, 1)[0]);
    for (int slots : {1, 2, 3}) {
      const std::vector<Frame> frames = render_frames({left_, left_, left_, left_}, {1, 2, 2, 1}, slots);
      EXPECT_TRUE(frames[1].picture.data == alone.picture.data) << slots;
      EXPECT_TRUE(frames[2].picture.data == alone.picture.data) << slots;
      EXPECT_TRUE(frames[3].picture.data == frames[0].picture.data) << slots;
      EXPECT_EQ(frames[1].timings[PassId::shadow_map] > 0, warped);
      EXPECT_EQ(frames[2].timings[PassId::shadow_map], 0);
      EXPECT_EQ(frames[3].timings[PassId::shadow_map] > 0, warped);
      for (const Frame& frame : frames) EXPECT_GT(frame.timings[PassId::id], 0);
    }
  }
}

TEST_F(KeptShadowMap, IsOneForAllSamplesOfAFrame) {
  job_.settings.shadow_warp = ShadowWarp::lispsm;
  std::vector<FrameRequest> requests;
  for (int place : {1, 2})
    for (int sample = 0; sample < 3; ++sample) {
      requests.push_back(request_of(left_, place));
      requests.back().sample_offset_px = sample_offset_px(sample);
    }
  for (int slots : {1, 2}) {
    const std::vector<Frame> frames = render_requests(requests, slots);
    for (size_t i = 0; i < frames.size(); ++i)
      EXPECT_EQ(frames[i].timings[PassId::shadow_map] > 0, i % 3 == 0) << "sample " << i << ", " << slots;
  }
}

// What a plan leaves out costs nothing.
TEST_F(KeptShadowMap, NoShadowsMeansNoShadowPasses) {
  job_.settings.shadows = ShadowMode::none;
  const Frame frame = std::move(render_lights({left_}, 1)[0]);
  for (PassId pass : {PassId::shadow_map, PassId::mark, PassId::readback, PassId::trace, PassId::upload})
    EXPECT_EQ(frame.timings[pass], 0) << kPassNames[static_cast<size_t>(pass)];
  for (PassId pass : {PassId::id, PassId::shade, PassId::download}) EXPECT_GT(frame.timings[pass], 0);
}

}  // namespace
}  // namespace hybridrt
