// The methods against each other: the five passes draw what rays see.

#include <cmath>

#include "core/image/compare.h"
#include "core/render/aov.h"
#include "tests/gl/frame_test.h"
#include "tests/gl/gl_test.h"

namespace hybridrt {
namespace {

constexpr const char* kScene = "scene:spheres,triangles=2000,reflective=20";
constexpr uint32_t kAllAovs = kAovId | kAovShadow | kAovMarked | kAovTraced | kAovDepth | kAovNormal;

Image aov(const Frame& frame, const std::string& name) {
  for (const ImageLayer& layer : frame.aovs)
    if (layer.name == name) return display_image(layer, frame.picture.width_px, frame.picture.height_px);
  throw std::runtime_error("no AOV " + name);
}

std::vector<Frame> render_with(RenderJob job, Method method, ShadowMode shadows) {
  job.settings.method = method;
  job.settings.shadows = shadows;
  job.settings.aovs = kAllAovs;
  return render_all(job);
}

bool same_pixel(const Image& a, const Image& b, size_t pixel, float bound = 0) {
  for (int c = 0; c < a.channels; ++c)
    if (!(std::abs(a.data[pixel * a.channels + c] - b.data[pixel * b.channels + c]) <= bound)) return false;
  return true;
}

struct Difference {
  double psnr_db;
  size_t compared, left_out, over_a_step;  ///< pixels; the last: off by more than 1/255
};

/// Compares the pixels that have the same id in both frames.
Difference difference_at_same_ids(const Frame& a, const Frame& b) {
  double sum = 0;
  Difference d{};
  const Image ids_a = aov(a, "id"), ids_b = aov(b, "id");
  for (size_t i = 0; i < a.picture.pixel_count(); ++i) {
    if (!same_pixel(ids_a, ids_b, i)) {
      ++d.left_out;
      continue;
    }
    ++d.compared;
    d.over_a_step += !same_pixel(a.picture, b.picture, i, 1.0f / 255);
    for (int c = 0; c < 3; ++c) {
      const double error = double(a.picture.data[3 * i + c]) - b.picture.data[3 * i + c];
      sum += error * error;
    }
  }
  d.psnr_db = sum > 0 ? -10 * std::log10(sum / (3.0 * d.compared)) : 200;
  return d;
}

class Methods : public GlTest {};

TEST_F(Methods, HybridWithRaysIsTheRaytracedPicture) {
  const RenderJob job = orbit_job(kScene, 3, 320, 240);
  const auto hybrid = render_with(job, Method::hybrid, ShadowMode::rays);
  const auto traced = render_with(job, Method::raytrace, ShadowMode::rays);
  double worst = 1000;
  for (size_t i = 0; i < hybrid.size(); ++i) {
    const Difference d = difference_at_same_ids(hybrid[i], traced[i]);
    EXPECT_GE(d.psnr_db, 50) << "frame " << i + 1;
    EXPECT_LE(d.left_out, d.compared / 1000) << "pixels whose ids differ";
    EXPECT_NEAR(hybrid[i].stats.pixels_hit, traced[i].stats.pixels_hit, 10);
    worst = std::min(worst, d.psnr_db);
  }
  RecordProperty("psnr_db", std::to_string(worst));
}

TEST_F(Methods, RaytracedIsTheReferencePicture) {
  const RenderJob job = orbit_job(kScene, 2, 320, 240);
  const auto traced = render_with(job, Method::raytrace, ShadowMode::rays);
  const auto reference = render_with(job, Method::reference, ShadowMode::rays);
  double worst = 1000;
  for (size_t i = 0; i < traced.size(); ++i) {
    const Difference d = difference_at_same_ids(traced[i], reference[i]);
    EXPECT_GE(d.psnr_db, 50);
    EXPECT_LE(d.left_out, d.compared / 1000);
    worst = std::min(worst, d.psnr_db);
  }
  RecordProperty("psnr_db", std::to_string(worst));
}

TEST_F(Methods, AccelerationStructuresAgree) {
  RenderJob job = orbit_job(kScene, 1, 320, 240);
  job.settings.accel = Accel::embree;
  const auto embree = render_with(job, Method::raytrace, ShadowMode::rays);
  job.settings.accel = Accel::kdtree;
  const auto kdtree = render_with(job, Method::raytrace, ShadowMode::rays);
  EXPECT_GE(difference_at_same_ids(embree[0], kdtree[0]).psnr_db, 50);
}

// The paper's claim: after the blur has marked the boundaries, few pixels are wrong, and rays were saved.
TEST_F(Methods, BlurDiffersFromRaysInFewPixels) {
  const RenderJob job = orbit_job(kScene, 3, 320, 240);
  const auto blur = render_with(job, Method::hybrid, ShadowMode::blur);
  const auto rays = render_with(job, Method::hybrid, ShadowMode::rays);
  size_t wrong = 0, pixels = 0, repaired = 0;
  for (size_t i = 0; i < blur.size(); ++i) {
    const Image ids_a = aov(blur[i], "id"), ids_b = aov(rays[i], "id");
    const Image a = aov(blur[i], "shadow"), b = aov(rays[i], "shadow"), marked = aov(blur[i], "marked");
    for (size_t p = 0; p < a.pixel_count(); ++p) {
      if (!same_pixel(ids_a, ids_b, p)) {  // only `rays` and `exact` repair ids
        ++repaired;
        continue;
      }
      const bool differs = !same_pixel(a, b, p);
      wrong += differs;
      EXPECT_FALSE(differs && marked.data[3 * p] > 0) << "a marked pixel has its own ray";
      // Where the shadows agree, the pictures agree.
      if (!differs) {
        EXPECT_TRUE(same_pixel(blur[i].picture, rays[i].picture, p)) << p;
      }
    }
    pixels += a.pixel_count();
    EXPECT_GT(blur[i].stats.primary_shadow_rays, 0);
    EXPECT_LT(blur[i].stats.primary_shadow_rays, rays[i].stats.primary_shadow_rays / 2);
    EXPECT_EQ(rays[i].stats.pixels_marked, rays[i].stats.pixels_hit);
  }
  EXPECT_LE(wrong, pixels / 10000);
  EXPECT_LE(repaired, pixels / 500);
  RecordProperty("wrong_per_million", static_cast<int>(1e6 * wrong / pixels));
}

// A coarse map errs visibly; the wider the kernel, the more of its errors are corrected.
TEST_F(Methods, WiderKernelsMarkMoreAndErrLess) {
  RenderJob job = orbit_job(kScene, 1, 320, 240);
  job.settings.shadow_map_px = 32;
  const auto rays = render_with(job, Method::hybrid, ShadowMode::rays);
  const auto map = render_with(job, Method::hybrid, ShadowMode::map);
  job.settings.blur_kernel_px = 1;
  EXPECT_TRUE(render_with(job, Method::hybrid, ShadowMode::blur)[0].picture.data == map[0].picture.data)
      << "a kernel of one pixel marks nothing";
  const auto wrong_pixels = [&](const Frame& frame) {
    size_t wrong = 0;
    const Image guessed = aov(frame, "shadow"), exact = aov(rays[0], "shadow");
    for (size_t p = 0; p < frame.picture.pixel_count(); ++p) wrong += !same_pixel(guessed, exact, p);
    return wrong;
  };
  int64_t marked = 0;
  size_t wrong = wrong_pixels(map[0]);
  EXPECT_GT(wrong, 100u) << "the map is no worse than rays";
  for (int kernel : {3, 9, 31}) {
    job.settings.blur_kernel_px = kernel;
    const auto blur = render_with(job, Method::hybrid, ShadowMode::blur);
    EXPECT_GT(blur[0].stats.pixels_marked, marked);
    EXPECT_LE(wrong_pixels(blur[0]), kernel == 3 ? wrong / 2 : wrong) << kernel;
    marked = blur[0].stats.pixels_marked;
    wrong = wrong_pixels(blur[0]);
  }
}

TEST_F(Methods, RasterIsHybridWithoutRays) {
  RenderJob job = orbit_job("scene:spheres,triangles=2000,reflective=0", 1);
  for (ShadowMode shadows : {ShadowMode::none, ShadowMode::map})
    EXPECT_TRUE(render_with(job, Method::raster, shadows)[0].picture.data ==
                render_with(job, Method::hybrid, shadows)[0].picture.data);
}

TEST_F(Methods, WithoutShadowsNothingIsDarker) {
  const RenderJob job = orbit_job("scene:spheres,triangles=2000,reflective=0", 1);
  const auto none = render_with(job, Method::hybrid, ShadowMode::none);
  const auto rays = render_with(job, Method::hybrid, ShadowMode::rays);
  EXPECT_EQ(none[0].stats.shadow_rays, 0);
  const Image ids_a = aov(none[0], "id"), ids_b = aov(rays[0], "id");
  size_t darker = 0;
  for (size_t i = 0; i < none[0].picture.data.size(); ++i) {
    if (!same_pixel(ids_a, ids_b, i / 3)) continue;
    EXPECT_GE(none[0].picture.data[i], rays[0].picture.data[i]);
    darker += none[0].picture.data[i] > rays[0].picture.data[i];
  }
  EXPECT_GT(darker, 1000u) << "there is no shadow in the picture";
}

// More samples come nearer to the truth, in the same way in every method.
TEST_F(Methods, SamplesConverge) {
  RenderJob job = orbit_job(kScene, 1, 160, 120);
  const auto with_samples = [&](Method method, int samples) {
    job.settings.samples = samples;
    return render_with(job, method, method == Method::hybrid ? ShadowMode::exact : ShadowMode::rays);
  };
  const auto truth = with_samples(Method::reference, 64);
  const auto error = [&](const std::vector<Frame>& frames) {
    double sum = 0;
    for (size_t i = 0; i < truth[0].picture.data.size(); ++i)
      sum += std::abs(double(frames[0].picture.data[i]) - truth[0].picture.data[i]);
    return sum / static_cast<double>(truth[0].picture.data.size());
  };
  const double one = error(with_samples(Method::hybrid, 1)), four = error(with_samples(Method::hybrid, 4)),
               sixteen = error(with_samples(Method::hybrid, 16));
  EXPECT_LT(four, 0.8 * one);
  EXPECT_LT(sixteen, 0.75 * four);
  EXPECT_LT(error(with_samples(Method::hybrid, 64)), 0.05 * one) << "the same pattern";
  EXPECT_LT(error(with_samples(Method::raytrace, 64)), 0.05 * one);
}

TEST_F(Methods, DepthZeroFiresNoSecondaryRays) {
  RenderJob job = orbit_job(kScene, 1);
  for (Method method : {Method::hybrid, Method::raytrace, Method::reference}) {
    job.settings.reflection_depth = 0;
    const auto flat = render_with(job, method, ShadowMode::rays);
    EXPECT_EQ(flat[0].stats.reflection_rays + flat[0].stats.refraction_rays, 0);
    job.settings.reflection_depth = 1;
    EXPECT_GT(render_with(job, method, ShadowMode::rays)[0].stats.reflection_rays, 0);
  }
}

// EGL and OSMesa of the same Mesa are the same rasteriser: the same bits. A GPU is compared by PSNR.
TEST_F(Methods, BindingsAgree) {
  std::string why;
  if (!has_context({gl::Binding::osmesa, ""}, &why)) GTEST_SKIP() << why;
  RenderJob job = orbit_job(kScene, 2, 320, 240);
  job.gl.binding = gl::Binding::osmesa;
  const auto osmesa = render_with(job, Method::hybrid, ShadowMode::blur);
  std::vector<gl::DeviceInfo> failed;
  for (const gl::ContextInfo& info : usable_devices(failed)) {
    if (info.device == "osmesa") continue;
    job.gl = {gl::Binding::any, info.device};
    const auto other = render_with(job, Method::hybrid, ShadowMode::blur);
    if (info.software) {
      expect_same_frames(other, osmesa, info.device);
    } else {
      EXPECT_GE(difference_at_same_ids(other[0], osmesa[0]).psnr_db, 50) << info.renderer;
    }
  }
}

}  // namespace
}  // namespace hybridrt
