// SSIM against its definition, written out per window, and against values known on paper.

#include "core/image/ssim.h"

#include <cmath>
#include <gtest/gtest.h>
#include <random>

namespace hybridrt {
namespace {

Image noise(int width, int height, int channels, uint32_t seed) {
  Image image(width, height, channels);
  std::mt19937 random(seed);
  for (float& v : image.data) v = std::uniform_real_distribution<float>(0, 1)(random);
  return image;
}

/// The paper's equation 13 window by window; grey pictures.
double by_definition(const Image& a, const Image& b) {
  double total = 0;
  int windows = 0;
  for (int y0 = 0; y0 + 11 <= a.height_px; ++y0)
    for (int x0 = 0; x0 + 11 <= a.width_px; ++x0) {
      double weights = 0, mean_a = 0, mean_b = 0;
      const auto over_window = [&](const auto& visit) {
        for (int y = 0; y < 11; ++y)
          for (int x = 0; x < 11; ++x)
            visit(std::exp(-((x - 5) * (x - 5) + (y - 5) * (y - 5)) / 4.5), *a.pixel(x0 + x, y0 + y),
                  *b.pixel(x0 + x, y0 + y));
      };
      over_window([&](double w, double p, double q) { weights += w, mean_a += w * p, mean_b += w * q; });
      mean_a /= weights, mean_b /= weights;
      double variance_a = 0, variance_b = 0, covariance = 0;
      over_window([&](double w, double p, double q) {
        variance_a += w / weights * (p - mean_a) * (p - mean_a);
        variance_b += w / weights * (q - mean_b) * (q - mean_b);
        covariance += w / weights * (p - mean_a) * (q - mean_b);
      });
      total += (2 * mean_a * mean_b + 1e-4) * (2 * covariance + 9e-4) /
               ((mean_a * mean_a + mean_b * mean_b + 1e-4) * (variance_a + variance_b + 9e-4));
      ++windows;
    }
  return total / windows;
}

TEST(StructuralSimilarity, IsTheDefinitions) {
  for (uint32_t seed = 1; seed <= 5; ++seed) {
    const Image a = noise(30 + 3 * seed, 17, 1, seed), b = noise(30 + 3 * seed, 17, 1, seed + 100);
    EXPECT_NEAR(structural_similarity(a, b), by_definition(a, b), 1e-10);
  }
}

TEST(StructuralSimilarity, EqualPicturesAreOneAndNegativesBelowZero) {
  const Image a = noise(40, 30, 3, 7);
  EXPECT_NEAR(structural_similarity(a, a), 1, 1e-12);
  Image negative = a;
  for (float& v : negative.data) v = 1 - v;
  EXPECT_LT(structural_similarity(a, negative), -0.5);
}

TEST(StructuralSimilarity, OfFlatPicturesIsTheTermOfTheMeans) {
  const Image a(20, 20, 3, 0.5f), b(20, 20, 3, 0.6f);
  EXPECT_NEAR(structural_similarity(a, b), (2 * 0.5 * 0.6 + 1e-4) / (0.25 + 0.36 + 1e-4), 1e-6);
  EXPECT_NEAR(structural_similarity(Image(3, 2, 3, 0.5f), Image(3, 2, 3, 0.6f)),
              (2 * 0.5 * 0.6 + 1e-4) / (0.25 + 0.36 + 1e-4), 1e-6);
}

TEST(StructuralSimilarity, AlphaDoesNotCount) {
  Image a = noise(20, 20, 4, 3), b = a;
  for (size_t i = 3; i < b.data.size(); i += 4) b.data[i] = 0;
  EXPECT_NEAR(structural_similarity(a, b), 1, 1e-12);
}

}  // namespace
}  // namespace hybridrt
