// --shadow-warp: what a frame's shadow map gets wrong, against a ray per pixel.

#include "core/render/gl_renderer.h"
#include "tests/gl/frame_test.h"
#include "tests/gl/gl_test.h"

namespace hybridrt {
namespace {

const std::vector<float>& aov(const Frame& frame, std::string_view name) {
  for (const ImageLayer& layer : frame.aovs)
    if (layer.name == name) return layer.values;
  throw std::runtime_error("no such AOV");
}

class ShadowWarpTest : public GlTest {
 protected:
  static Frame render(RenderJob job, ShadowMode shadows, ShadowWarp warp) {
    job.settings.shadows = shadows;
    job.settings.shadow_warp = warp;
    job.settings.aovs = kAovShadow;
    return std::move(render_all(job)[0]);
  }

  static size_t wrong_pixels(const Frame& frame, const Frame& truth) {
    const std::vector<float>&a = aov(frame, "shadow"), &b = aov(truth, "shadow");
    size_t wrong = 0;
    for (size_t i = 0; i < a.size(); ++i) wrong += a[i] != b[i];
    return wrong;
  }

  /// Near the floor, looking over all of it.
  static RenderJob low_over_floor() {
    RenderJob job = orbit_job("scene:spheres,triangles=3000,reflective=0", 1, 320, 240);
    const dvec3 middle(job.scene.bounds.center()), size(job.scene.bounds.extent());
    const dvec3 eye = job.scene.origin_world + middle + dvec3(-0.49, 0.1, 0.03) * size;
    job.motion.course = Camera{eye, eye + dvec3(1, -0.15, 0), {0, 1, 0}, 0.9};
    job.settings.shadow_map_px = 512;
    job.settings.reflection_depth = 0;
    return job;
  }
};

TEST_F(ShadowWarpTest, LowOverAFloorFewerPixelsAreWrong) {
  RenderJob job = low_over_floor();
  for (const dvec3& toward : {dvec3(-0.5, 1, 0.2), dvec3(1, 0.5, -0.6), dvec3(0.3, 0.1, -0.8)}) {
    job.lights.lights[0].toward = glm::normalize(toward);
    const Frame truth = render(job, ShadowMode::rays, ShadowWarp::uniform);
    size_t wrong[2][2];
    for (int blur : {0, 1})
      for (int warped : {0, 1})
        wrong[blur][warped] = wrong_pixels(
            render(job, blur ? ShadowMode::blur : ShadowMode::map, warped ? ShadowWarp::lispsm : ShadowWarp::uniform),
            truth);
    EXPECT_LT(2 * wrong[0][1], wrong[0][0]) << "light " << toward.y;
    EXPECT_LE(wrong[1][1], wrong[1][0]) << "light " << toward.y;
  }
}

// Under every light, even along the view and against it, the warped map is at least about as good.
TEST_F(ShadowWarpTest, NoLightIsMuchWorseThanUniform) {
  RenderJob job = low_over_floor();
  const Camera camera = camera_at(job.motion, 1);
  const dvec3 forward = glm::normalize(camera.target_world - camera.eye_world);
  std::vector<dvec3> lights = {forward, -forward, glm::normalize(dvec3(0.01, 0, 0) - forward), {0, 1, 0}};
  for (int x : {-1, 0, 1})
    for (int y : {-1, 0, 1})
      for (int z : {-1, 1}) lights.push_back(glm::normalize(dvec3(x, y + 0.01, z)));
  size_t uniform = 0, warped = 0;
  for (const dvec3& toward : lights) {
    job.lights.lights[0].toward = toward;
    const Frame truth = render(job, ShadowMode::rays, ShadowWarp::uniform);
    const size_t before = wrong_pixels(render(job, ShadowMode::map, ShadowWarp::uniform), truth),
                 now = wrong_pixels(render(job, ShadowMode::map, ShadowWarp::lispsm), truth);
    EXPECT_LE(now, before + 76800 / 200) << toward.x << ' ' << toward.y << ' ' << toward.z;
    uniform += before;
    warped += now;
  }
  EXPECT_LT(warped, uniform);
  RecordProperty("uniform", static_cast<int>(uniform));
  RecordProperty("warped", static_cast<int>(warped));
}

// A part of a frame is fitted to what the whole frame sees.
TEST_F(ShadowWarpTest, ACropHasTheWholesPixels) {
  for (ShadowMode shadows : {ShadowMode::map, ShadowMode::blur})
    for (int samples : {1, 3}) {
      RenderJob job = low_over_floor();
      job.settings.samples = samples;
      const Frame whole = render(job, shadows, ShadowWarp::lispsm);
      const PixelRect crop{100, 90, 120, 100};
      job.settings.crop = crop;
      const Frame part = render(job, shadows, ShadowWarp::lispsm);
      ASSERT_EQ(part.picture.width_px, crop.width_px);
      for (int y = 0; y < crop.height_px; ++y)
        for (int x = 0; x < 3 * crop.width_px; ++x)
          ASSERT_EQ(part.picture.data[static_cast<size_t>(y) * 3 * crop.width_px + x],
                    whole.picture.data[(static_cast<size_t>(y) + crop.y_px) * 3 * 320 + 3 * crop.x_px + x]);
    }
}

// If nothing is in view, there is nothing to fit a map to.
TEST_F(ShadowWarpTest, NothingInView) {
  RenderJob job = low_over_floor();
  Camera away = camera_at(job.motion, 1);
  away.target_world = away.eye_world + dvec3(0, 1, 0);
  away.up = {1, 0, 0};
  away.eye_world.y += 100;
  away.target_world.y += 100;
  job.motion.course = away;
  const Frame frame = render(job, ShadowMode::blur, ShadowWarp::lispsm);
  EXPECT_EQ(frame.stats.pixels_hit, 0);
}

}  // namespace
}  // namespace hybridrt
