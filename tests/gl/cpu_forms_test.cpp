// The CPU forms of the passes against their GL forms: whole frames, and why pixels differ where they do.

#include <cmath>
#include <fmt/format.h>

#include "tests/gl/frame_test.h"
#include "tests/support/textured_scenes.h"

namespace hybridrt {
namespace {

const ImageLayer& layer(const Frame& frame, std::string_view name) {
  for (const ImageLayer& aov : frame.aovs)
    if (aov.name == name) return aov;
  throw std::logic_error("no such layer");
}

constexpr const char* kHoles = "textured_room()";

struct FormsCase {
  const char* name;
  const char* scene;
  ShadowMode shadows;
  ShadowWarp warp = ShadowWarp::lispsm;
  dvec3 toward{0, 0, 0};  ///< the light; 0: the default light
  int lights = 1, samples = 1, shadow_map_px = 2048;
  Method method = Method::hybrid;
  std::optional<PixelRect> crop = std::nullopt;
  friend void PrintTo(const FormsCase& c, std::ostream* out) { *out << c.name; }
};

/// Whether values differ within a pixel of (x, y).
bool is_edge(const std::vector<float>& values, int width, int x, int y) {
  const int height = static_cast<int>(values.size()) / width;
  for (int v = std::max(0, y - 1); v <= std::min(height - 1, y + 1); ++v)
    for (int u = std::max(0, x - 1); u <= std::min(width - 1, x + 1); ++u)
      if (values[static_cast<size_t>(v) * width + u] != values[static_cast<size_t>(y) * width + x]) return true;
  return false;
}

class CpuForms : public testing::TestWithParam<FormsCase> {
 protected:
  void SetUp() override {
    std::string why;
    if (!has_context({}, &why)) GTEST_SKIP() << why;
  }

  static RenderJob job_of(const FormsCase& c) {
    RenderJob job =
        std::string_view(c.scene) == kHoles ? orbit_job(textured_room(), 3, 480, 360) : orbit_job(c.scene, 3, 480, 360);
    EXPECT_EQ(job.scene.has_holes(), std::string_view(c.scene) == kHoles);
    RenderSettings& s = job.settings;
    s.shadows = c.shadows, s.shadow_warp = c.warp, s.method = c.method, s.samples = c.samples;
    s.shadow_map_px = c.shadow_map_px, s.crop = c.crop;
    s.aovs = kAovId | kAovShadow | kAovMarked;
    std::vector<DirectionalLight>& lights = job.lights.lights;
    if (c.toward != dvec3(0)) lights[0].toward = glm::normalize(c.toward);
    if (c.lights > 1) lights.push_back({glm::normalize(dvec3(-0.7, 0.5, 0.6)), vec3(0.4f)});
    if (c.lights > 2) lights.push_back({glm::normalize(dvec3(0.2, 0.9, -0.6)), vec3(0.3f), false});
    return job;
  }

  /// The shadows that rays find, in double precision.
  static std::vector<Frame> truth_of(RenderJob job) {
    job.settings.method = Method::reference;
    job.settings.shadows = job.settings.shadows == ShadowMode::none ? ShadowMode::none : ShadowMode::rays;
    job.settings.samples = 1;
    return render_all(job, nullptr, 2);
  }

  /// Pixels that differ by more than a step of 8 bits are few. Each sees another triangle, as the GL snaps corners, or
  /// lies at a shadow's edge: that of both maps, or the true one where that is thinner than a texel.
  static void compare(const Frame& gl, const Frame& cpu, const Frame& truth, int samples, const std::string& what) {
    const int width = gl.picture.width_px, channels = gl.picture.channels;
    const auto &gl_ids = layer(gl, "id").numbers, &cpu_ids = layer(cpu, "id").numbers;
    const auto &gl_lit = layer(gl, "shadow").values, &cpu_lit = layer(cpu, "shadow").values;
    const size_t pixels = gl.picture.pixel_count();
    size_t differ = 0, other_triangles = 0, shadow_edges = 0;
    for (size_t i = 0; i < pixels; ++i) {
      float off = 0;
      for (int c = 0; c < channels; ++c)
        off = std::max(off, std::abs(gl.picture.data[channels * i + c] - cpu.picture.data[channels * i + c]));
      if (off <= 1.0f / 255) continue;
      ++differ;
      if (samples > 1) continue;  // AOVs are those of the first sample
      const int x = static_cast<int>(i) % width, y = static_cast<int>(i) / width;
      const bool other_triangle = gl_ids[i] != cpu_ids[i];
      const bool shadow_edge =
          gl_lit[i] != cpu_lit[i] && ((is_edge(gl_lit, width, x, y) && is_edge(cpu_lit, width, x, y)) ||
                                      is_edge(layer(truth, "shadow").values, width, x, y));
      other_triangles += other_triangle, shadow_edges += shadow_edge && !other_triangle;
      EXPECT_TRUE(other_triangle || shadow_edge)
          << what << ": " << x << ' ' << y << " is off by " << off << ", lit " << gl_lit[i] << " and " << cpu_lit[i];
    }
    EXPECT_LE(differ, pixels / 1000) << what;
    RecordProperty(what, fmt::format("{} of {} differ: {} see another triangle, {} at a shadow's edge", differ, pixels,
                                     other_triangles, shadow_edges));
  }
};

TEST_P(CpuForms, DrawWhatTheGlFormsDraw) {
  RenderJob job = job_of(GetParam());
  const std::vector<Frame> gl = render_all(job);
  job.settings.forms = PassForms::cpu;
  const std::vector<Frame> cpu = render_all(job, nullptr, 2);
  const std::vector<Frame> truth = truth_of(job);
  ASSERT_EQ(gl.size(), cpu.size());
  for (size_t f = 0; f < gl.size(); ++f) {
    ASSERT_EQ(gl[f].picture.data.size(), cpu[f].picture.data.size());
    compare(gl[f], cpu[f], truth[f], GetParam().samples, fmt::format("{}_{}", GetParam().name, f + 1));
    const TraceStats &s = gl[f].stats, &t = cpu[f].stats;
    EXPECT_NEAR(s.pixels_hit, t.pixels_hit, 0.001 * s.pixels_hit);
    EXPECT_NEAR(s.pixels_lit, t.pixels_lit, 0.001 * s.pixels_hit);
    EXPECT_NEAR(s.pixels_marked, t.pixels_marked, 0.004 * s.pixels_hit);  // a bit marks all of its window
    EXPECT_NEAR(s.primary_shadow_rays, t.primary_shadow_rays, 0.004 * s.pixels_hit);
    EXPECT_NEAR(s.reflection_rays, t.reflection_rays, 0.002 * s.pixels_hit);
  }
}

TEST(CpuFormsAtEdges, SamplesAreTheSame) {
  std::string why;
  if (!has_context({}, &why)) GTEST_SKIP() << why;
  for (const ShadowMode shadows : {ShadowMode::exact, ShadowMode::none}) {
    RenderJob job = orbit_job("scene:chess,triangles=20000", 2, 320, 240);
    job.settings.shadows = shadows;
    job.settings.samples = 8, job.settings.adaptive = true;
    const std::vector<Frame> gl = render_all(job);
    job.settings.forms = PassForms::cpu;
    const std::vector<Frame> cpu = render_all(job, nullptr, 2);
    ASSERT_EQ(gl.size(), 2u);
    for (size_t f = 0; f < gl.size(); ++f) {
      size_t differ = 0;
      for (size_t i = 0; i < gl[f].picture.data.size(); ++i)
        differ += std::abs(gl[f].picture.data[i] - cpu[f].picture.data[i]) > 1.0f / 255;
      EXPECT_LE(differ, gl[f].picture.data.size() / 1000) << name_of(shadows);
      EXPECT_NEAR(gl[f].stats.pixels_resampled, cpu[f].stats.pixels_resampled, 20);
      EXPECT_GT(gl[f].stats.pixels_resampled, 1000);
    }
  }
}

constexpr const char* kChess = "scene:chess,triangles=20000";
constexpr const char* kSpheres = "scene:spheres,triangles=8000,reflective=30";
constexpr const char* kThin = "scene:thin,triangles=20000";

constexpr const char* kStillLife = HYBRIDRT_SCENES "/still_life.obj";
constexpr dvec3 kLow{-1, 0.2, 0.3};

INSTANTIATE_TEST_SUITE_P(
    Frames, CpuForms,
    testing::Values(
        FormsCase{"chess_none", kChess, ShadowMode::none}, FormsCase{"chess_map", kChess, ShadowMode::map},
        FormsCase{"chess_blur", kChess, ShadowMode::blur},
        FormsCase{.name = "chess_raster", .scene = kChess, .shadows = ShadowMode::map, .method = Method::raster},
        FormsCase{"spheres_none", kSpheres, ShadowMode::none}, FormsCase{"spheres_map", kSpheres, ShadowMode::map},
        FormsCase{"spheres_blur", kSpheres, ShadowMode::blur}, FormsCase{"thin_none", kThin, ShadowMode::none},
        FormsCase{"thin_map", kThin, ShadowMode::map}, FormsCase{"thin_blur", kThin, ShadowMode::blur},
        FormsCase{"still_life_map", kStillLife, ShadowMode::map},
        FormsCase{"still_life_blur", kStillLife, ShadowMode::blur}, FormsCase{"holes_map", kHoles, ShadowMode::map},
        FormsCase{"holes_blur", kHoles, ShadowMode::blur},
        FormsCase{.name = "holes_raster", .scene = kHoles, .shadows = ShadowMode::map, .method = Method::raster},
        FormsCase{"uniform_map", kSpheres, ShadowMode::map, ShadowWarp::uniform},
        FormsCase{"uniform_blur", kThin, ShadowMode::blur, ShadowWarp::uniform},
        FormsCase{"low_sun_map", kSpheres, ShadowMode::map, ShadowWarp::lispsm, kLow},
        FormsCase{"low_sun_blur", kHoles, ShadowMode::blur, ShadowWarp::lispsm, kLow},
        FormsCase{.name = "lights_map", .scene = kSpheres, .shadows = ShadowMode::map, .lights = 3},
        FormsCase{.name = "lights_blur", .scene = kStillLife, .shadows = ShadowMode::blur, .lights = 3},
        FormsCase{.name = "coarse_map", .scene = kStillLife, .shadows = ShadowMode::map, .shadow_map_px = 200},
        FormsCase{.name = "samples_blur", .scene = kSpheres, .shadows = ShadowMode::blur, .samples = 3},
        FormsCase{
            .name = "crop_blur", .scene = kSpheres, .shadows = ShadowMode::blur, .crop = PixelRect{140, 90, 230, 170}}),
    [](const auto& forms) { return forms.param.name; });

}  // namespace
}  // namespace hybridrt
