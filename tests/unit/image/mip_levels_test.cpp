// Mip levels against averages in double precision.

#include "core/image/mip_levels.h"

#include <cmath>
#include <gtest/gtest.h>
#include <random>

#include "core/image/srgb.h"

namespace hybridrt {
namespace {

uint32_t texel(uint32_t red, uint32_t green, uint32_t blue, uint32_t alpha = 255) {
  return red | green << 8 | blue << 16 | alpha << 24;
}

/// The display code of a channel's average over the part of `image` that a texel of a level covers.
double average_code(const std::vector<uint32_t>& image, int width, int height, int x, int y, int level_width,
                    int level_height, int channel) {
  double sum = 0, all = 0;
  const double scale_x = double(width) / level_width, scale_y = double(height) / level_height;
  for (int j = 0; j < height; ++j)
    for (int i = 0; i < width; ++i) {
      const double share_x = std::min((x + 1) * scale_x, i + 1.0) - std::max(x * scale_x, double(i));
      const double share_y = std::min((y + 1) * scale_y, j + 1.0) - std::max(y * scale_y, double(j));
      if (share_x <= 0 || share_y <= 0) continue;
      const uint32_t t = image[size_t(j) * width + i];
      const double weight = share_x * share_y * ((t >> 24) + 0.25);
      sum += weight * linear_from_srgb((t >> 8 * channel & 255) / 255.0);
      all += weight;
    }
  return 255 * srgb_from_linear(sum / all);
}

TEST(MipLevels, ArePiecewiseAveragesInLinearLight) {
  std::mt19937 random(3);
  for (const auto& [width, height] : {std::pair{8, 8}, {16, 4}, {1, 6}, {2, 1}, {32, 2}}) {
    std::vector<uint32_t> image;
    for (int i = 0; i < width * height; ++i) image.push_back(random() | (i % 3 ? 0xFF000000u : 0u));
    std::vector<uint32_t> texels = image;
    texels.resize(mip_texel_count(width, height));
    const int levels = fill_mip_levels(texels, width, height);
    size_t first = image.size();
    int w = width, h = height;
    for (int level = 1; level < levels; ++level, first += size_t(w) * h) {
      w = std::max(w / 2, 1), h = std::max(h / 2, 1);
      for (int y = 0; y < h; ++y)
        for (int x = 0; x < w; ++x)
          for (int channel = 0; channel < 3; ++channel)
            EXPECT_NEAR(texels[first + size_t(y) * w + x] >> 8 * channel & 255,
                        average_code(image, width, height, x, y, w, h, channel), 0.51)
                << width << 'x' << height << " level " << level;
    }
    EXPECT_EQ(first, texels.size());
    EXPECT_EQ(w * h, 1) << "down to one texel";
  }
}

TEST(MipLevels, OddSizesLoseNothing) {
  std::mt19937 random(5);
  for (const auto& [width, height] : {std::pair{7, 5}, {3, 3}, {1, 3}, {13, 1}}) {
    std::vector<uint32_t> texels;
    for (int i = 0; i < width * height; ++i) texels.push_back(random() | 0xFF000000u);
    const std::vector<uint32_t> image = texels;
    texels.resize(mip_texel_count(width, height));
    fill_mip_levels(texels, width, height);
    for (int channel = 0; channel < 3; ++channel)
      EXPECT_NEAR(texels.back() >> 8 * channel & 255, average_code(image, width, height, 0, 0, 1, 1, channel), 0.51)
          << width << 'x' << height;
  }
}

TEST(MipLevels, HolesDoNotBleed) {
  std::vector<uint32_t> texels{texel(10, 200, 30), texel(255, 0, 255, 0), texel(255, 0, 255, 0), texel(10, 200, 30), 0};
  EXPECT_EQ(fill_mip_levels(texels, 2, 2), 2);
  EXPECT_NEAR(texels[4] & 255, 10, 3);
  EXPECT_NEAR(texels[4] >> 8 & 255, 200, 1);
  EXPECT_EQ(texels[4] >> 24, 128u) << "half of it is there";
}

TEST(MipLevels, OneTexelIsAllThereIs) {
  std::vector<uint32_t> texels{5};
  EXPECT_EQ(fill_mip_levels(texels, 1, 1), 1);
  EXPECT_EQ(texels[0], 5u);
}

}  // namespace
}  // namespace hybridrt
