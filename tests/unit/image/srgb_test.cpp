#include "core/image/srgb.h"

#include <cmath>
#include <gtest/gtest.h>
#include <limits>

namespace hybridrt {
namespace {

/// IEC 61966-2-1, written again so that the code under test is not compared with itself.
int code_by_formula(float linear) {
  const double x = std::fmin(1.0, std::fmax(0.0, static_cast<double>(linear)));
  const double display = x <= 0.0031308 ? x * 12.92 : 1.055 * std::pow(x, 1.0 / 2.4) - 0.055;
  return static_cast<int>(std::floor(255 * display + 0.5));
}

TEST(Srgb, CodesEqualTheFormula) {
  for (int i = -1000; i <= 2100000; ++i) {
    const float linear = static_cast<float>(i) / 2000000.0f;
    ASSERT_EQ(srgb8_from_linear(linear), code_by_formula(linear)) << linear;
  }
}

TEST(Srgb, CodesChangeExactlyWhereTheFormulaDoes) {
  for (int code = 1; code < 256; ++code) {
    float x = static_cast<float>(linear_from_srgb((code - 0.5) / 255));
    for (int i = 0; i < 50; ++i) x = std::nextafter(x, 0.0f);
    for (int i = 0; i < 100; ++i, x = std::nextafter(x, 1.0f)) ASSERT_EQ(srgb8_from_linear(x), code_by_formula(x));
  }
}

TEST(Srgb, EveryCodeComesBack) {
  for (int code = 0; code < 256; ++code)
    EXPECT_EQ(srgb8_from_linear(static_cast<float>(linear_from_srgb(code / 255.0))), code);
}

TEST(Srgb, ExtremesAreClamped) {
  EXPECT_EQ(srgb8_from_linear(-1.0f), 0);
  EXPECT_EQ(srgb8_from_linear(1e-30f), 0);
  EXPECT_EQ(srgb8_from_linear(7.0f), 255);
  EXPECT_EQ(srgb8_from_linear(std::numeric_limits<float>::infinity()), 255);
  EXPECT_EQ(srgb8_from_linear(std::numeric_limits<float>::quiet_NaN()), 0);
}

TEST(Srgb, AlphaTakesNoCurve) {
  Image image(1, 1, 4, 0.5f);
  EXPECT_EQ(srgb8_from_linear(image), (std::vector<uint8_t>{188, 188, 188, 128}));
  EXPECT_EQ(srgb8_from_linear(Image(1, 1, 2, 0.5f)), (std::vector<uint8_t>{188, 128}));
  EXPECT_NEAR(linear_from_srgb(image).data[0], 0.2140, 1e-4);
  EXPECT_EQ(linear_from_srgb(image).data[3], 0.5f);
}

}  // namespace
}  // namespace hybridrt
