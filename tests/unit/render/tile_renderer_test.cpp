// The five passes on the CPU, tile by tile, against the ray tracer.

#include "core/render/tile_renderer.h"

#include <cmath>
#include <gtest/gtest.h>

#include "core/image/compare.h"
#include "core/render/aov.h"
#include "tests/support/cpu_frames.h"
#include "tests/support/textured_scenes.h"
#include "tests/support/trace_scenes.h"

namespace hybridrt {
namespace {

/// Ids and shadows must be the reference's at every pixel, colours the same up to single precision's secondary hits.
void expect_as_the_reference(RenderJob job, ShadowMode shadows) {
  job.settings.shadows = shadows;
  const std::vector<Frame> hybrid = frames_of(job);
  job.settings.method = Method::reference;
  job.settings.shadows = shadows == ShadowMode::none ? ShadowMode::none : ShadowMode::rays;
  const std::vector<Frame> reference = frames_of(job);
  ASSERT_EQ(hybrid.size(), reference.size());
  for (size_t f = 0; f < hybrid.size(); ++f) {
    EXPECT_EQ(layer(hybrid[f], "id").numbers, layer(reference[f], "id").numbers) << "frame " << f;
    if (shadows != ShadowMode::none) {
      EXPECT_EQ(layer(hybrid[f], "shadow").values, layer(reference[f], "shadow").values) << "frame " << f;
    }
    EXPECT_EQ(layer(hybrid[f], "depth").values, layer(reference[f], "depth").values);
    EXPECT_EQ(hybrid[f].stats.pixels_hit, reference[f].stats.pixels_hit);
    EXPECT_EQ(hybrid[f].stats.pixels_lit, reference[f].stats.pixels_lit);
    const Image &a = hybrid[f].picture, &b = reference[f].picture;
    size_t off = 0;
    double squares = 0;
    for (size_t i = 0; i < a.data.size(); ++i) {
      const double difference = double(a.data[i]) - b.data[i];
      off += std::abs(difference) > 1.0 / 255, squares += difference * difference;
    }
    EXPECT_LE(off, a.data.size() / 5000) << "frame " << f;
    EXPECT_LE(squares / a.data.size(), 1e-5) << "frame " << f;
  }
}

TEST(TileRenderer, GivesTheReferencesIdsShadowsAndColours) {
  for (const char* scene :
       {"scene:chess,triangles=10000", "scene:spheres,triangles=4000,reflective=30", "scene:thin,triangles=20000"})
    for (const ShadowMode shadows : {ShadowMode::exact, ShadowMode::rays, ShadowMode::none}) {
      SCOPED_TRACE(fmt::format("{} {}", scene, name_of(shadows)));
      expect_as_the_reference(cpu_job_of(scene, 2), shadows);
    }
}

TEST(TileRenderer, TexturesAndHoles) {
  RenderJob job = cpu_job_of(textured_room(), 2);
  expect_as_the_reference(job, ShadowMode::exact);
}

TEST(TileRenderer, ACropIsAPartOfTheWholeFrame) {
  RenderJob job = cpu_job_of("scene:spheres,triangles=4000,reflective=30", 1);
  const Frame whole = frames_of(job).at(0);
  job.settings.crop = PixelRect{37, 21, 150, 99};
  const Frame part = frames_of(job).at(0);
  for (int y = 0; y < 99; ++y)
    for (int x = 0; x < 150; ++x)
      for (int c = 0; c < 3; ++c)
        ASSERT_EQ(part.picture.data[3 * (150 * y + x) + c], whole.picture.data[3 * (330 * (y + 21) + x + 37) + c])
            << x << ' ' << y;
}

TEST(TileRenderer, ThePictureIsTheSameForAnyNumberOfThreads) {
  RenderJob job = cpu_job_of("scene:spheres,triangles=2000,reflective=30", 2);
  job.settings.width_px = 300, job.settings.height_px = 150, job.settings.samples = 2;
  const std::vector<Frame> one = frames_of(job, 1);
  for (int round = 0; round < 40; ++round) {
    const std::vector<Frame> many = frames_of(job, 2 + round % 4);
    for (size_t f = 0; f < one.size(); ++f) ASSERT_EQ(one[f].picture.data, many[f].picture.data) << round;
  }
}

TEST(TileRenderer, AlphaIsCoverage) {
  RenderJob job = cpu_job_of("scene:spheres,triangles=4000", 1);
  job.settings.alpha = true;
  const Frame frame = frames_of(job).at(0);
  ASSERT_EQ(frame.picture.channels, 4);
  const ImageLayer& ids = layer(frame, "id");
  for (size_t i = 0; i < ids.numbers.size(); ++i)
    ASSERT_EQ(frame.picture.data[4 * i + 3], ids.numbers[i] == kNoTriangle ? 0 : 1);
}

}  // namespace
}  // namespace hybridrt
