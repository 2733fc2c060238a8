// A cube on a ground that is up to ten million times as wide: nothing in view is cut away or torn, no shadow is lost.

#include "tests/gl/frame_test.h"
#include "tests/gl/gl_test.h"
#include "tests/support/trace_scenes.h"

namespace hybridrt {
namespace {

class LargeSceneTest : public GlTest {
 protected:
  static RenderJob cube_on_ground(float half_size) {
    Scene scene = closed_box();
    const float s = half_size;
    add_triangle(scene, {-s, 0, -s}, {s, 0, s}, {s, 0, -s});
    add_triangle(scene, {-s, 0, -s}, {-s, 0, s}, {s, 0, s});
    scene.bounds.grow({-s, 0, -s});
    scene.bounds.grow({s, 0, s});
    scene.normals = {vec3(0, 1, 0)};
    scene.triangle_normals.assign(scene.triangle_count(), uvec3(0));
    scene.materials = {Material{}};
    scene.triangle_materials.assign(scene.triangle_count(), 0);
    RenderJob job = orbit_job(std::move(scene), 1, 256, 192);
    job.settings.shadow_map_px = 2048;
    return job;
  }

  static Image picture(RenderJob job, Method method, ShadowMode shadows, ShadowWarp warp = ShadowWarp::lispsm) {
    job.settings.method = method;
    job.settings.shadows = shadows;
    job.settings.shadow_warp = warp;
    return std::move(render_all(job)[0].picture);
  }

  static int different_pixels(const Image& a, const Image& b) {
    int count = 0;
    for (int y = 0; y < a.height_px; ++y)
      for (int x = 0; x < a.width_px; ++x) count += std::abs(a.pixel(x, y)[0] - b.pixel(x, y)[0]) > 0.004f;
    return count;
  }
};

TEST_F(LargeSceneTest, HybridIsTheReference) {
  Random random(5);
  for (float size : {1e3f, 1e4f, 1e5f, 3e5f, 1e6f, 1e7f})
    for (int i = 0; i < 4; ++i) {
      RenderJob job = cube_on_ground(size);
      const dvec3 eye(random.between(2, 6), random.between(0.3f, 4), random.between(2, 6));
      job.motion.course = Camera{eye, {0.5, 0.5, 0.5}, {0, 1, 0}, 0.8};
      job.lights.lights[0].toward = glm::normalize(dvec3(random.between(-1, 1), 0.7, random.between(-1, 1)));
      EXPECT_EQ(different_pixels(picture(job, Method::hybrid, ShadowMode::exact),
                                 picture(job, Method::reference, ShadowMode::rays)),
                0)
          << size;
    }
}

TEST_F(LargeSceneTest, TheWarpIsAtLeastAsGoodAsNone) {
  for (float size : {1e3f, 1e4f, 2e4f, 1e5f, 1e6f}) {
    RenderJob job = cube_on_ground(size);
    job.motion.course = Camera{{4, 2.5, 6}, {0.5, 0.5, 0.5}, {0, 1, 0}, 0.8};
    job.lights.lights[0].toward = glm::normalize(dvec3(2, 3, 1));
    const Image truth = picture(job, Method::hybrid, ShadowMode::rays);
    for (ShadowMode shadows : {ShadowMode::map, ShadowMode::blur}) {
      const int uniform = different_pixels(picture(job, Method::hybrid, shadows, ShadowWarp::uniform), truth);
      EXPECT_LE(different_pixels(picture(job, Method::hybrid, shadows), truth), uniform) << size;
      EXPECT_GT(uniform, 20) << "a shadow is in view";
    }
  }
}

}  // namespace
}  // namespace hybridrt
