// See-through things cast a full shadow, whatever d, Tf and Ni, but none where they have holes. The light stands
// straight above a pane over a floor, so the shadow is the pane's outline.

#include "tests/gl/frame_test.h"
#include "tests/support/load_scene.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/textured_scenes.h"

namespace hybridrt {
namespace {

constexpr int kWidth_px = 240, kHeight_px = 160;
constexpr float kFloor = 0.5f, kAmbient = 0.15f;

struct Mode {
  Method method;
  ShadowMode shadows;
};

class TransparentShadows : public testing::TestWithParam<Mode> {
 protected:
  void SetUp() override {
    std::string why;
    if (!has_context({}, &why)) GTEST_SKIP() << why;
  }

  /// A floor (triangles 0 and 1) and a pane at height 1 over x and z from -1 to 1, u along x and v along -z.
  static Scene pane_over_floor(const std::string& pane) {
    const TemporaryFolder folder;
    folder.write("leaf.png", "x");
    folder.write("a.mtl", "newmtl floor\nKd 0.5 0.5 0.5\nnewmtl pane\nKd 0.5 0.5 0.5\n" + pane);
    const std::filesystem::path obj =
        folder.write("a.obj",
                     "mtllib a.mtl\nv -4 0 -4\nv -4 0 4\nv 4 0 4\nv 4 0 -4\nusemtl floor\nf 1 2 3 4\n"
                     "vt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\n"
                     "v -1 1 1\nv 1 1 1\nv 1 1 -1\nv -1 1 -1\nusemtl pane\nf 5/1 6/2 7/3 8/4\n");
    LoadWatch watch;
    watch.textures = texel_files(pattern_named);
    ThreadPool pool(1);
    Warnings warnings;
    return load_scene(obj.string(), pool, warnings, std::nullopt, watch);
  }

  /// `blocked(x, z)`: whether the pane is above that place of the floor.
  template <typename Blocked>
  void expect_shadow(const std::string& pane, const Blocked& blocked) {
    RenderJob job = orbit_job(pane_over_floor(pane), 1, kWidth_px, kHeight_px);
    job.settings.method = GetParam().method;
    job.settings.shadows = GetParam().shadows;
    job.settings.aovs = kAovId | kAovShadow;
    job.motion.course = Camera{{0.1, 0.8, 3.5}, {0, 0, 0}, {0, 1, 0}, 0.8};  // below the pane, past it to the floor
    job.lights.lights = {{dvec3(0, 1, 0), vec3(1)}};
    const Frame frame = std::move(render_all(job).front());
    const View view = make_view(camera_at(job.motion, 1), job.scene.origin_world, kWidth_px, kHeight_px);
    int in_shadow = 0, in_light = 0;
    for (int y = 0; y < kHeight_px; ++y)
      for (int x = 0; x < kWidth_px; ++x) {
        const size_t i = static_cast<size_t>(y) * kWidth_px + x;
        if (frame.aovs[0].numbers[i] > 1) continue;  // not the floor
        const dvec3 dir = view.pixel_dir(x, y), eye = view.eye + job.scene.origin_world;
        const dvec3 p = eye - eye.y / dir.y * dir;
        const bool dark = blocked(p.x, p.z);
        bool near_edge = false;
        for (const double dx : {-kEdge, kEdge})
          for (const double dz : {-kEdge, kEdge}) near_edge |= blocked(p.x + dx, p.z + dz) != dark;
        if (near_edge) continue;
        (dark ? in_shadow : in_light)++;
        ASSERT_EQ(frame.aovs[1].values[i], dark ? 0 : 1) << p.x << ' ' << p.z;
        const float expected = kFloor * (dark ? kAmbient : kAmbient + 1);
        for (int c = 0; c < 3; ++c) ASSERT_NEAR(frame.picture.data[3 * i + c], expected, 1e-6f) << p.x << ' ' << p.z;
      }
    EXPECT_GT(in_shadow, 500);
    EXPECT_GT(in_light, 2000);
  }

  static constexpr double kEdge = 0.006;
};

bool under_pane(double x, double z) { return std::max(std::abs(x), std::abs(z)) < 1; }

TEST_P(TransparentShadows, ADissolvedPaneCastsAFullOne) { expect_shadow("d 0.25\nTf 1 0.5 0\n", under_pane); }

TEST_P(TransparentShadows, AVanishingOneToo) { expect_shadow("d 0\n", under_pane); }

TEST_P(TransparentShadows, SoDoesGlass) { expect_shadow("d 0.1\nTf 0.9 1 0.9\nNi 1.5\nillum 7\n", under_pane); }

TEST_P(TransparentShadows, LightFallsThroughHoles) {
  expect_shadow("map_Kd leaf.png\n", [](double x, double z) {
    if (!under_pane(x, z)) return false;
    // pattern_named: 32 x 32 texels, row 0 on top, round holes.
    const int i = static_cast<int>((x + 1) * 16) % 16 - 8, j = static_cast<int>((z + 1) * 16) % 16 - 8;
    return i * i + j * j >= 30;
  });
}

INSTANTIATE_TEST_SUITE_P(Modes, TransparentShadows,
                         testing::Values(Mode{Method::hybrid, ShadowMode::exact},
                                         Mode{Method::hybrid, ShadowMode::rays}, Mode{Method::hybrid, ShadowMode::blur},
                                         Mode{Method::raytrace, ShadowMode::rays},
                                         Mode{Method::reference, ShadowMode::rays}),
                         [](const auto& mode) {
                           return std::string(name_of(mode.param.method)) + "_" +
                                  std::string(name_of(mode.param.shadows));
                         });

}  // namespace
}  // namespace hybridrt
