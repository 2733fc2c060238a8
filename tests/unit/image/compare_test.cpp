#include "core/image/compare.h"

#include <cmath>
#include <gtest/gtest.h>
#include <limits>

namespace hybridrt {
namespace {

/// An image without equal neighbours, values 0-1.
Image checkered(int width, int height, int channels = 3) {
  Image image(width, height, channels);
  for (size_t i = 0; i < image.data.size(); ++i) image.data[i] = static_cast<float>(i * 37 % 256) / 255.0f;
  return image;
}

TEST(Compare, EqualImagesAreTheSame) {
  const Image image = checkered(40, 30);
  const CompareResult result = compare_images(image, image);
  EXPECT_TRUE(result.same);
  EXPECT_TRUE(result.measured);
  EXPECT_TRUE(std::isinf(result.psnr_db));
  EXPECT_EQ(result.max_error, 0);
  EXPECT_EQ(result.reason, "");
}

TEST(Compare, MetricsOfOnePlantedPixel) {
  const Image reference = checkered(10, 10);
  Image image = reference;
  image.pixel(7, 3)[1] =
      reference.pixel(7, 3)[1] < 0.5f ? reference.pixel(7, 3)[1] + 0.05f : reference.pixel(7, 3)[1] - 0.05f;
  const CompareResult result = compare_images(image, reference);
  EXPECT_NEAR(result.max_error, 0.05, 1e-6);
  EXPECT_EQ(result.max_x, 7);
  EXPECT_EQ(result.max_y, 3);
  EXPECT_EQ(result.max_channel, 1);
  EXPECT_NEAR(result.mean_abs_error, 0.05 / 300, 1e-8);
  EXPECT_NEAR(result.rmse, 0.05 / std::sqrt(300.0), 1e-7);
  EXPECT_NEAR(result.psnr_db, 10 * std::log10(300 / (0.05 * 0.05)), 1e-3);
  EXPECT_EQ(result.pixels_over_fail, 1u);
  EXPECT_EQ(result.pixels_over_hard_fail, 0u);
  EXPECT_FALSE(result.same) << "1 % of the pixels fail, 0.1 % may";

  CompareLimits lenient;
  lenient.fail_percent = 1.0;
  EXPECT_TRUE(compare_images(image, reference, lenient).same) << "exactly the allowed share is allowed";
}

TEST(Compare, OneHardPixelIsEnough) {
  const Image reference(100, 100, 3, 0.25f);
  Image image = reference;
  image.pixel(99, 99)[2] = 0.5f;
  const CompareResult result = compare_images(image, reference);
  EXPECT_LT(result.percent_over_fail(), 0.1);
  EXPECT_EQ(result.pixels_over_hard_fail, 1u);
  EXPECT_FALSE(result.same);
  EXPECT_NE(result.reason.find("(99, 99)"), std::string::npos) << result.reason;
}

TEST(Compare, OneStepOfEightBitsPasses) {
  Image reference(16, 16, 3), image(16, 16, 3);
  for (size_t i = 0; i < image.data.size(); ++i) {
    reference.data[i] = static_cast<float>(i % 255) / 255.0f;
    image.data[i] = static_cast<float>(i % 255 + 1) / 255.0f;
  }
  EXPECT_TRUE(compare_images(image, reference).same);
  for (float& value : image.data) value += 1 / 255.0f;
  EXPECT_FALSE(compare_images(image, reference).same);
}

TEST(Compare, ImageShiftedByOnePixelDiffers) {
  const Image reference = checkered(40, 30);
  Image image = reference;
  for (int y = 0; y < 30; ++y)
    for (int x = 1; x < 40; ++x)
      for (int c = 0; c < 3; ++c) image.pixel(x, y)[c] = reference.pixel(x - 1, y)[c];
  EXPECT_FALSE(compare_images(image, reference).same);
}

TEST(Compare, BlackFrameDiffers) { EXPECT_FALSE(compare_images(Image(40, 30, 3), checkered(40, 30)).same); }

TEST(Compare, OtherSizeAndChannelsAreVerdicts) {
  const CompareResult size = compare_images(Image(40, 30, 3), Image(30, 40, 3));
  EXPECT_FALSE(size.same);
  EXPECT_FALSE(size.measured);
  EXPECT_NE(size.reason.find("40x30"), std::string::npos) << size.reason;
  const CompareResult channels = compare_images(Image(40, 30, 3), Image(40, 30, 4));
  EXPECT_FALSE(channels.same);
  EXPECT_NE(channels.reason.find("4"), std::string::npos) << channels.reason;
}

TEST(Compare, NonFiniteInEitherIsAVerdictEvenWhenEqual) {
  for (const float bad : {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity()}) {
    Image broken(8, 8, 3, 0.5f);
    broken.pixel(5, 2)[1] = bad;
    for (const auto& [image, reference] : {std::pair{broken, Image(8, 8, 3, 0.5f)},
                                           std::pair{Image(8, 8, 3, 0.5f), broken}, std::pair{broken, broken}}) {
      const CompareResult result = compare_images(image, reference, {1e9, 100, 1e9});
      EXPECT_FALSE(result.same);
      EXPECT_NE(result.reason.find("pixel (5, 2), channel 1"), std::string::npos) << result.reason;
    }
  }
}

TEST(DifferenceImage, IsAmplifiedClampedAndOpaque) {
  Image a(3, 1, 4, 0.5f), b(3, 1, 4, 0.5f);
  a.pixel(0, 0)[1] = 0.52f;
  a.pixel(1, 0)[0] = 1.0f;
  a.pixel(2, 0)[3] = 0.53f;
  const Image difference = difference_image(a, b, 10);
  ASSERT_EQ(difference.channels, 3);
  EXPECT_EQ(difference.pixel(0, 0)[0], 0);
  EXPECT_NEAR(difference.pixel(0, 0)[1], 0.2, 1e-5);
  EXPECT_EQ(difference.pixel(1, 0)[0], 1);
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(difference.pixel(2, 0)[c], 0.3, 1e-5) << "alpha shows in every colour";
}

TEST(DifferenceImage, NaNShowsWhite) {
  Image a(1, 1, 1, 0.5f), b(1, 1, 1, std::numeric_limits<float>::quiet_NaN());
  EXPECT_EQ(difference_image(a, b, 10).data, UninitializedVector<float>(3, 1.0f));
}

}  // namespace
}  // namespace hybridrt
