// Which pixels contrast with a neighbour, against the definition, pixel by pixel.

#include "core/image/contrast.h"

#include <cmath>
#include <gtest/gtest.h>
#include <random>

namespace hybridrt {
namespace {

bool differs(const Image& picture, int x, int y, int u, int v, float threshold) {
  if (u < 0 || v < 0 || u >= picture.width_px || v >= picture.height_px) return false;
  for (int c = 0; c < picture.channels; ++c) {
    const float a = picture.data[(static_cast<size_t>(y) * picture.width_px + x) * picture.channels + c];
    const float b = picture.data[(static_cast<size_t>(v) * picture.width_px + u) * picture.channels + c];
    if (std::abs(std::sqrt(a) - std::sqrt(b)) > threshold) return true;
  }
  return false;
}

TEST(Contrast, IsMarkedOnBothSides) {
  std::mt19937 random(7);
  ThreadPool pool(3);
  for (const auto& [width, height] : {std::pair(1, 1), {1, 70}, {97, 1}, {33, 65}, {200, 131}})
    for (const int channels : {1, 3, 4}) {
      // Mostly flat, so that both answers are common.
      Image picture(width, height, channels, 0.25f);
      std::uniform_int_distribution<size_t> place(0, picture.data.size() - 1);
      std::uniform_real_distribution<float> value(0.2f, 0.3f);
      for (size_t i = 0; i < picture.data.size() / 20 + 1; ++i) picture.data[place(random)] = value(random);
      std::vector<uint8_t> marks(picture.pixel_count());
      constexpr float kThreshold = 0.02f;
      mark_contrasts(picture, kThreshold, pool, marks);
      for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
          bool expected = false;
          for (const auto& [u, v] : {std::pair(x - 1, y), {x + 1, y}, {x, y - 1}, {x, y + 1}})
            expected |= differs(picture, x, y, u, v, kThreshold);
          ASSERT_EQ(marks[static_cast<size_t>(y) * width + x], expected) << x << ' ' << y << ' ' << width;
        }
    }
}

TEST(Contrast, IsOfSquareRoots) {
  const float dark[] = {0.0f}, less_dark[] = {0.0016f}, bright[] = {0.8f}, brighter[] = {0.8016f}, below[] = {-1.0f};
  EXPECT_TRUE(contrasts(dark, less_dark, 10.0f / 255));
  EXPECT_FALSE(contrasts(bright, brighter, 10.0f / 255));
  EXPECT_FALSE(contrasts(dark, below, 10.0f / 255));
}

}  // namespace
}  // namespace hybridrt
