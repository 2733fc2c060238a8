// Samples where there are edges, of pictures that are known on paper.

#include "core/render/edge_samples.h"

#include <cmath>
#include <gtest/gtest.h>
#include <mutex>

#include "core/render/samples.h"

namespace hybridrt {
namespace {

constexpr int kWidth = 300, kHeight = 200, kSamples = 16;

/// What is seen at a point of the picture, in pixels; a pixel's centre lies at + 0.5.
using Scene2d = std::function<vec4(const dvec2& at)>;

const vec4 kBlack(0.1f, 0.1f, 0.1f, 1), kWhite(0.9f, 0.8f, 0.7f, 1);

/// A line of `width_px` through (20, 20), with the slope `slope`; only where `from` <= x < `to`.
Scene2d line(double width_px, double slope, double from = 20, double to = 280) {
  const dvec2 across = glm::normalize(dvec2(-slope, 1));
  return [=](const dvec2& at) {
    const bool on = std::abs(glm::dot(at - dvec2(20, 20.3), across)) < width_px / 2 && at.x >= from && at.x < to;
    return on ? kWhite : kBlack;
  };
}

Scene2d disc() {
  return [](const dvec2& at) { return glm::distance(at, dvec2(140.2, 99.7)) < 63.4 ? kWhite : kBlack; };
}

vec4 sample_of(const Scene2d& scene, PixelAt at, int sample) {
  return scene(dvec2(at.x + 0.5, at.y + 0.5) + sample_offset_px(sample));
}

Image first_samples(const Scene2d& scene, int channels) {
  Image picture(kWidth, kHeight, channels);
  for (int y = 0; y < kHeight; ++y)
    for (int x = 0; x < kWidth; ++x) {
      const vec4 color = sample_of(scene, {x, y}, 0);
      std::copy_n(&color.x, channels, &picture.data[(static_cast<size_t>(y) * kWidth + x) * channels]);
    }
  return picture;
}

struct Sampled {
  Image picture;
  int64_t pixels;
};

Sampled sampled_at_edges(const Scene2d& scene, int threads = 2, bool retake_first = false) {
  Sampled result{first_samples(scene, 3), 0};
  ThreadPool pool(threads);
  EdgeMemory memory;
  const EdgeSampling sampling{kSamples, retake_first};
  const auto take = [&](std::span<const PixelAt> pixels, const GiveColors& give) {
    parallel_for(pool, pixels.size(), 64, [&](size_t begin, size_t end) {
      std::vector<vec4> colors;
      for (int sample = sampling.first_taken(); sample < kSamples; ++sample)
        for (size_t i = begin; i < end; ++i) colors.push_back(sample_of(scene, pixels[i], sample));
      give(begin, end - begin, colors);
    });
  };
  result.pixels = sample_edges(result.picture, sampling, pool, memory, take);
  return result;
}

vec3 mean_of(const Scene2d& scene, PixelAt at) {
  vec3 sum(0);
  for (int sample = 0; sample < kSamples; ++sample) sum += vec3(sample_of(scene, at, sample));
  return sum / static_cast<float>(kSamples);
}

vec3 pixel_of(const Image& picture, PixelAt at) {
  const float* const p = &picture.data[(static_cast<size_t>(at.y) * kWidth + at.x) * 3];
  return {p[0], p[1], p[2]};
}

/// How many pixels are not the mean of all samples, though they should be.
int wrong_pixels(const Scene2d& scene, const Image& picture) {
  int wrong = 0;
  for (int y = 0; y < kHeight; ++y)
    for (int x = 0; x < kWidth; ++x) wrong += glm::distance(mean_of(scene, {x, y}), pixel_of(picture, {x, y})) > 1e-5f;
  return wrong;
}

TEST(EdgeSamples, AnEdgeIsWhatAllSamplesMakeOfIt) {
  const Sampled sampled = sampled_at_edges(disc());
  // Pixels that the circle touches in a corner only, and no centre beside them differs, are left.
  EXPECT_LE(wrong_pixels(disc(), sampled.picture), 8);
  EXPECT_GT(wrong_pixels(disc(), first_samples(disc(), 3)), 350);
  // Two pixels on each of about 4 * 127 crossings of rows and columns at most.
  EXPECT_GT(sampled.pixels, 500);
  EXPECT_LT(sampled.pixels, 1100);
}

TEST(EdgeSamples, ALineThinnerThanAPixelIsFollowed) {
  for (const double width_px : {0.3, 0.5, 0.7})
    for (const double slope : {0.013, 0.21, 0.6}) {
      const Scene2d scene = line(width_px, slope);
      const int wrong = wrong_pixels(scene, sampled_at_edges(scene).picture);
      const int jagged = wrong_pixels(scene, first_samples(scene, 3));
      EXPECT_LE(wrong, jagged / 10) << width_px << ' ' << slope;
    }
}

TEST(EdgeSamples, WhatNoCentreMeetsIsMissed) {
  const Scene2d speck = line(0.2, 0, 100.6, 100.9);
  EXPECT_EQ(sampled_at_edges(speck).pixels, 0);
}

TEST(EdgeSamples, PixelsAreFirstSamplesOrMeansOfAll) {
  for (const Scene2d& scene : {disc(), line(0.4, 0.3)}) {
    const Image first = first_samples(scene, 3);
    const Sampled sampled = sampled_at_edges(scene);
    int64_t means = 0;
    for (int y = 0; y < kHeight; ++y)
      for (int x = 0; x < kWidth; ++x) {
        const vec3 pixel = pixel_of(sampled.picture, {x, y});
        if (pixel == pixel_of(first, {x, y})) continue;
        ++means;
        ASSERT_EQ(pixel, mean_of(scene, {x, y})) << x << ' ' << y;
      }
    EXPECT_LE(means, sampled.pixels);
    EXPECT_EQ(sampled_at_edges(scene, 2, /*retake_first=*/true).picture.data, sampled.picture.data);
  }
}

TEST(EdgeSamples, AreTheSameForAnyNumberOfThreads) {
  const Scene2d scene = line(0.3, 0.21);
  const Sampled one = sampled_at_edges(scene, 1);
  for (int round = 0; round < 40; ++round) {
    const Sampled many = sampled_at_edges(scene, 2 + round % 4);
    ASSERT_EQ(many.pixels, one.pixels) << round;
    ASSERT_EQ(many.picture.data, one.picture.data) << round;
  }
}

TEST(EdgeSamples, OfAFlatPictureAreNone) {
  int calls = 0;
  Image picture(70, 50, 4, 0.5f);
  ThreadPool pool(2);
  EdgeMemory memory;
  const auto take = [&](std::span<const PixelAt>, const GiveColors&) { ++calls; };
  EXPECT_EQ(sample_edges(picture, {8, false}, pool, memory, take), 0);
  EXPECT_EQ(calls, 0);
  EXPECT_EQ(picture.data, Image(70, 50, 4, 0.5f).data);
}

}  // namespace
}  // namespace hybridrt
