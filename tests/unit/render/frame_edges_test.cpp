// Frames with samples at edges only: each pixel is the frame's with one sample, or that with all.

#include "core/render/frame_edges.h"

#include <cmath>

#include "core/base/error.h"
#include "tests/support/cpu_frames.h"
#include "tests/support/textured_scenes.h"

namespace hybridrt {
namespace {

struct Pictures {
  Frame one, all, adaptive;
};

Pictures pictures_of(RenderJob job, int samples) {
  Pictures pictures;
  job.settings.samples = 1;
  pictures.one = frames_of(job).at(0);
  job.settings.samples = samples;
  pictures.all = frames_of(job).at(0);
  job.settings.adaptive = true;
  pictures.adaptive = frames_of(job).at(0);
  return pictures;
}

/// Pixels that are neither.
size_t odd_pixels(const Pictures& p) {
  const size_t channels = p.one.picture.channels;
  const auto equal = [&](const Frame& a, size_t i) {
    return std::equal(&a.picture.data[i * channels], &a.picture.data[(i + 1) * channels],
                      &p.adaptive.picture.data[i * channels]);
  };
  size_t odd = 0;
  for (size_t i = 0; i < p.one.picture.pixel_count(); ++i) odd += !equal(p.one, i) && !equal(p.all, i);
  return odd;
}

double psnr_db(const Image& a, const Image& b) {
  double squares = 0;
  for (size_t i = 0; i < a.data.size(); ++i) squares += std::pow(std::sqrt(a.data[i]) - std::sqrt(b.data[i]), 2);
  return -10 * std::log10(squares / static_cast<double>(a.data.size()));
}

void expect_all_samples_at_edges(const RenderJob& job, size_t most_odd) {
  const Pictures p = pictures_of(job, 8);
  EXPECT_LE(odd_pixels(p), most_odd);
  EXPECT_GT(p.adaptive.stats.pixels_resampled, 0);
  EXPECT_EQ(p.all.stats.pixels_resampled, 0);
  const double before = psnr_db(p.one.picture, p.all.picture), after = psnr_db(p.adaptive.picture, p.all.picture);
  EXPECT_GE(after, before + 9) << before;
  for (const char* aov : {"id", "depth", "shadow", "marked"}) {
    EXPECT_EQ(layer(p.adaptive, aov).numbers, layer(p.one, aov).numbers) << aov;
    EXPECT_EQ(layer(p.adaptive, aov).values, layer(p.one, aov).values) << aov;
  }
}

TEST(FrameEdges, HaveAllSamplesInEveryMethod) {
  for (const char* scene : {"scene:chess,triangles=10000", "scene:thin,triangles=20000"})
    for (const Method method : {Method::hybrid, Method::raytrace, Method::reference})
      for (const bool shadows : {true, false}) {
        if (method == Method::reference && !shadows) continue;
        SCOPED_TRACE(fmt::format("{} {} {}", scene, name_of(method), shadows));
        RenderJob job = cpu_job_of(scene, 1);
        job.settings.method = method;
        job.settings.shadows = shadows ? default_shadows(method) : ShadowMode::none;
        job.settings.aovs &= ~uint32_t{kAovNormal | kAovTraced};
        // Few samples are found by rays, in single precision, and by the rasteriser where all are taken.
        expect_all_samples_at_edges(job, method == Method::hybrid ? 20 : 0);
      }
}

TEST(FrameEdges, TexturesAreFilteredOverTheSamplesPart) {
  for (const Method method : {Method::raytrace, Method::reference}) {
    RenderJob job = cpu_job_of(textured_room(), 1);
    job.settings.method = method;
    job.settings.shadows = default_shadows(method);
    EXPECT_EQ(odd_pixels(pictures_of(job, 4)), 0u) << name_of(method);
  }
}

TEST(FrameEdges, AlphaIsCoverage) {
  for (const Method method : {Method::raytrace, Method::reference, Method::hybrid}) {
    RenderJob job = cpu_job_of("scene:spheres,triangles=4000", 1);
    job.settings.alpha = true;
    job.settings.method = method;
    job.settings.shadows = default_shadows(method);
    const Pictures p = pictures_of(job, 4);
    EXPECT_LE(odd_pixels(p), method == Method::hybrid ? 5u : 0u) << name_of(method);
    size_t partly = 0;
    for (size_t i = 3; i < p.adaptive.picture.data.size(); i += 4)
      partly += p.adaptive.picture.data[i] > 0 && p.adaptive.picture.data[i] < 1;
    EXPECT_GT(partly, 100u);
  }
}

TEST(FrameEdges, AreTheSameForAnyNumberOfThreads) {
  RenderJob job = cpu_job_of("scene:thin,triangles=10000", 2);
  job.settings.width_px = 200, job.settings.height_px = 130;
  job.settings.samples = 4, job.settings.adaptive = true;
  const std::vector<Frame> one = frames_of(job, 1);
  for (int round = 0; round < 40; ++round) {
    const std::vector<Frame> many = frames_of(job, 2 + round % 4);
    for (size_t f = 0; f < one.size(); ++f) ASSERT_EQ(one[f].picture.data, many[f].picture.data) << round;
  }
}

TEST(FrameEdges, NeedMoreThanOneSampleAndNoShadowMap) {
  RenderSettings settings;
  settings.adaptive = true;
  EXPECT_THROW(require_adaptive_fits(settings), Error);
  settings.samples = 8;
  EXPECT_NO_THROW(require_adaptive_fits(settings));
  for (const ShadowMode shadows : {ShadowMode::map, ShadowMode::blur}) {
    settings.shadows = shadows;
    EXPECT_THROW(require_adaptive_fits(settings), Error);
  }
}

}  // namespace
}  // namespace hybridrt
