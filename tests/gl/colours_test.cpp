// Colours of vertices and faces look alike in every method, in mirrors and under textures too.

#include <cmath>

#include "tests/gl/frame_test.h"
#include "tests/gl/gl_test.h"
#include "tests/support/textured_scenes.h"
#include "tests/support/trace_scenes.h"

namespace hybridrt {
namespace {

/// Each corner of each triangle gets one of a few strong colours.
void paint(Scene& scene) {
  Random random(5);
  for (int i = 0; i < 50; ++i) scene.colors.push_back(random.in_cube(0, 1));
  for (size_t i = 0; i < scene.triangle_count(); ++i)
    scene.triangle_colors.emplace_back(random.below(50), random.below(50), random.below(50));
}

class Colours : public GlTest {
 protected:
  static Frame render_with(RenderJob job, Method method, ShadowMode shadows) {
    job.settings.method = method;
    job.settings.shadows = shadows;
    job.settings.accel = Accel::kdtree;
    return render_all(job)[0];
  }
  static double share_of_other_pixels(const Frame& a, const Frame& b) {
    size_t others = 0;
    for (size_t i = 0; i < a.picture.pixel_count(); ++i) {
      float worst = 0;
      for (size_t c = 0; c < 3; ++c)
        worst = std::max(worst, std::abs(a.picture.data[3 * i + c] - b.picture.data[3 * i + c]));
      others += worst > 1.0f / 255;
    }
    return static_cast<double>(others) / static_cast<double>(a.picture.pixel_count());
  }
};

TEST_F(Colours, AreTheSameInEveryMethod) {
  for (const bool textured : {false, true}) {
    SCOPED_TRACE(textured);
    RenderJob job =
        textured ? orbit_job(textured_room(), 1) : orbit_job("scene:spheres,triangles=3000,reflective=30", 1);
    const Frame plain = render_with(job, Method::hybrid, ShadowMode::exact);
    const double edges =
        share_of_other_pixels(plain, render_with(job, Method::reference, ShadowMode::rays));  // without colours
    paint(job.scene);
    const Frame reference = render_with(job, Method::reference, ShadowMode::rays);
    EXPECT_GT(share_of_other_pixels(plain, reference), 0.2) << "colours are seen";
    EXPECT_LE(share_of_other_pixels(render_with(job, Method::hybrid, ShadowMode::exact), reference), edges + 0.0005);
    EXPECT_LE(share_of_other_pixels(render_with(job, Method::raytrace, ShadowMode::rays), reference), edges + 0.001);
  }
}

}  // namespace
}  // namespace hybridrt
