// shaders/texture.glsl as C++: filter, wrapping, mip levels and holes against formulas in double precision.

#include "core/trace/texture_lookup.h"

#include <gtest/gtest.h>

#include "core/image/srgb.h"
#include "core/trace/holes.h"
#include "tests/support/textured_scenes.h"
#include "tests/support/trace_scenes.h"

namespace hybridrt {
namespace {

constexpr double kFinest = 0;  // footprint

struct Texture {
  Scene scene;
  TextureLookup<double> in_double;
  TextureLookup<float> in_single;
  uint32_t maps, record;

  explicit Texture(const TexelImage& image, const TextureMap& map = {})
      : scene(textured_triangle(image, map)),
        in_double{scene.textures->words.data()},
        in_single{scene.textures->words.data()},
        maps(scene.textures->triangle_maps[0]),
        record(scene.textures->words[maps]) {}
  dvec3 at(double u, double v, double footprint = kFinest) {
    return in_double.texture_color(record, dvec2(u, v), footprint);
  }
};

TexelImage noise() { return pattern_named("noise", 100, 1000); }

dvec3 linear(uint32_t texel) {
  return {linear_from_srgb((texel & 255) / 255.0), linear_from_srgb((texel >> 8 & 255) / 255.0),
          linear_from_srgb((texel >> 16 & 255) / 255.0)};
}

int wrapped(int i, int size, bool clamped) { return clamped ? std::clamp(i, 0, size - 1) : ((i % size) + size) % size; }

/// The textbook's bilinear filter.
dvec3 bilinear(const TexelImage& image, double u, double v, bool clamped) {
  if (clamped) u = std::clamp(u, 0.0, 1.0), v = std::clamp(v, 0.0, 1.0);
  const double x = u * image.width_px - 0.5, y = (1 - v) * image.height_px - 0.5;
  dvec3 sum(0);
  for (int j = 0; j < 2; ++j)
    for (int i = 0; i < 2; ++i) {
      const double at_x = std::floor(x) + i, at_y = std::floor(y) + j;
      const double weight = (1 - std::abs(x - at_x)) * (1 - std::abs(y - at_y));
      const int column = wrapped(static_cast<int>(at_x), image.width_px, clamped),
                row = wrapped(static_cast<int>(at_y), image.height_px, clamped);
      sum += weight * linear(image.texels[static_cast<size_t>(row) * image.width_px + column]);
    }
  return sum;
}

double difference(const dvec3& a, const dvec3& b) {
  const dvec3 d = glm::abs(a - b);
  return std::max({d.x, d.y, d.z});
}

TEST(TextureLookup, IsBilinearAndRepeatsOrStops) {
  const TexelImage image = noise();
  Random random(1);
  for (const bool clamped : {false, true}) {
    TextureMap map;
    map.clamped = clamped;
    Texture texture(image, map);
    for (int i = 0; i < 2000; ++i) {
      const double u = random.between(-3, 4), v = random.between(-3, 4);
      EXPECT_LT(difference(texture.at(u, v), bilinear(image, u, v, clamped)), 1e-6) << u << ' ' << v;
      EXPECT_LT(difference(dvec3(texture.in_single.texture_color(texture.record, vec2(u, v), 0)), texture.at(u, v)),
                2e-4);
    }
    for (const double corner : {0.0, 1.0, -1.0, 2.0, 1e6, -1e6})
      EXPECT_LT(difference(texture.at(corner, corner), bilinear(image, corner, corner, clamped)), 1e-6) << corner;
  }
}

TEST(Log2BySeries, IsTheLogarithmAndWholeAtPowersOfTwo) {
  for (int power = -100; power <= 100; ++power) EXPECT_EQ(log2_by_series(std::ldexp(1.0f, power)), power);
  Random random(2);
  for (int i = 0; i < 100'000; ++i) {
    const float x = std::ldexp(random.between(1.0f, 2.0f), static_cast<int>(random.below(100)) - 20);
    const double truth = std::log2(static_cast<double>(x));
    ASSERT_NEAR(log2_by_series(x), truth, std::max(2e-7, std::abs(truth) * 0x1p-23)) << x;
  }
}

TEST(TextureLookup, VGrowsUpward) {
  Texture texture({1, 2, false, {texel_of(255, 0, 0), texel_of(0, 0, 255)}});
  EXPECT_EQ(texture.at(0.5, 0.75), dvec3(1, 0, 0)) << "the first row is on top";
  EXPECT_EQ(texture.at(0.5, 0.25), dvec3(0, 0, 1));
}

TEST(TextureLookup, OptionsOfTheStatement) {
  const TexelImage image = noise();
  TextureMap map;
  map.scale = {2, -0.5f}, map.offset = {0.25f, 3}, map.base = 0.125f, map.gain = -0.75f;
  Texture texture(image, map);
  for (const double u : {0.1, 0.7}) {
    const dvec3 expected = glm::max(0.125 - 0.75 * bilinear(image, 2 * u + 0.25, -0.5 * u + 3, false), dvec3(0));
    EXPECT_LT(difference(texture.at(u, u), expected), 1e-6);
  }
}

// Alternately black and white: each level but the finest is the average.
TEST(TextureLookup, LevelIsHalfTheLogarithmOfTheTexelsInAPixel) {
  constexpr int kSide_px = 16;
  TexelImage image{kSide_px, kSide_px, false, {}};
  for (int i = 0; i < kSide_px * kSide_px; ++i)
    image.texels.push_back((i / kSide_px + i) % 2 ? 0xFFFFFFFFu : 0xFF000000u);
  Texture texture(image);
  const double u = 0.5 / kSide_px, white = texture.at(3 * u, u).x - texture.at(u, u).x;
  EXPECT_EQ(std::abs(white), 1) << "texel centres";
  const double texel = 1.0 / (kSide_px * kSide_px);
  const auto contrast = [&](double texels) { return std::abs(texture.at(3 * u, u, texels * texel).x - 0.5); };
  EXPECT_NEAR(contrast(1), 0.5, 1e-9);
  EXPECT_NEAR(contrast(0.01), 0.5, 1e-9) << "magnified";
  EXPECT_NEAR(contrast(2), 0.25, 0.004) << "half way to level 1";
  EXPECT_NEAR(contrast(4), 0, 0.004) << "level 1, as near as 8 bits come";
  EXPECT_NEAR(contrast(1e30), 0, 0.004);

  // Each level is a different grey, which tells them apart.
  Texture coarse({4, 4, false, std::vector<uint32_t>(16, texel_of(0, 0, 0))});
  std::vector<uint32_t> words = coarse.scene.textures->words;
  const uint32_t first = words[coarse.record + HRT_TEXTURE_FIRST];
  ASSERT_EQ(words.size(), first + 16u + 4 + 1);
  for (uint32_t i = 16; i < 20; ++i) words[first + i] = texel_of(255, 255, 255);
  coarse.in_double.words = words.data();
  EXPECT_NEAR(coarse.at(0.3, 0.8, 4 / 16.0).x, 1, 1e-12);
  EXPECT_NEAR(coarse.at(0.3, 0.8, 16 / 16.0).x, 0, 1e-12);
  EXPECT_NEAR(coarse.at(0.3, 0.8, 8 / 16.0).x, 0.5, 1e-12);
}

TEST(TextureLookup, ScaleMakesAPixelCoverMoreTexels) {
  const TexelImage image = noise();
  TextureMap twice;
  twice.scale = vec2(2);
  Texture plain(image), scaled(image, twice);
  EXPECT_LT(difference(plain.at(0.2, 0.6, 0.4), scaled.at(0.1, 0.3, 0.1)), 1e-6);
  EXPECT_GT(difference(plain.at(0.2, 0.6, 0.1), scaled.at(0.1, 0.3, 0.1)), 0.01);
}

TEST(TextureLookup, FootprintOfAPixel) {
  Texture texture(noise());
  const auto footprint = [&](const dvec3& dir, double stretch) {
    return texture.in_double.pixel_footprint({2, 0, 0}, {0, 2, 0}, dvec2(stretch, 0), dvec2(0, 1), dir, 1e-6, 5);
  };
  // Two units across are one of the texture: 1e-6 * 5² of area are a quarter of that.
  EXPECT_NEAR(footprint({0, 0, -1}, 1), 25e-6 / 4, 1e-15);
  EXPECT_NEAR(footprint({0, 0, 1}, 3), 3 * 25e-6 / 4, 1e-15) << "either side";
  EXPECT_NEAR(footprint({std::sqrt(0.75), 0, -0.5}, 1), 2 * 25e-6 / 4, 1e-12) << "at 60 degrees";
  EXPECT_EQ(footprint({0, 0, -1}, 0), 0) << "no area in the texture";
  EXPECT_EQ(footprint({1, 0, 0}, 1), 1e30) << "edge-on";
  EXPECT_TRUE(std::isfinite(texture.at(0.5, 0.5, 1e30).x));
}

TEST(TextureLookup, HolesAreNearestTexelsUnderOneHalf) {
  TexelImage image{4, 1, true, {}};
  for (const uint32_t alpha : {0u, 127u, 128u, 255u}) image.texels.push_back(texel_of(9, 9, 9, alpha));
  Texture texture(image);
  const bool expected[] = {true, true, false, false};
  for (int i = -8; i < 16; ++i)
    EXPECT_EQ(texture.in_double.has_hole(texture.maps, dvec2((i + 0.5) / 8, 0.3)), expected[((i + 8) / 2) % 4]) << i;
  EXPECT_TRUE(is_hole(*texture.scene.textures, 0, 0.49, 0.1)) << "u is 0.49";
  EXPECT_FALSE(is_hole(*texture.scene.textures, 0, 0.51, 0.1));
  EXPECT_FALSE(texture.in_double.has_hole(0, dvec2(0))) << "no maps";
  Texture opaque(noise());
  EXPECT_FALSE(opaque.scene.has_holes());
}

TEST(TextureLookup, WhatLiesInHolesDoesNotBleed) {
  Texture texture({2, 1, true, {texel_of(0, 255, 0), texel_of(255, 0, 255, 0)}});
  EXPECT_LT(difference(texture.at(0.45, 0.5), dvec3(0, 1, 0)), 0.002);
}

}  // namespace
}  // namespace hybridrt
