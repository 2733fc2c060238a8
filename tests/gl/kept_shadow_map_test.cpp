// A still light's shadow map is kept, a warped one only while the camera stands still too; else it is drawn anew.

#include "core/render/gl_renderer.h"
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
          if (begun == lights.size()) return std::nullopt;
          const DirectionalLight light{glm::normalize(lights[begun]), vec3(1)};
          const Camera camera = camera_at(job_.motion, places[begun]);
          return FrameRequest{static_cast<int>(++begun), camera, {light}};
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
