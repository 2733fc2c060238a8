#include "core/image/contact_sheet.h"

#include <gtest/gtest.h>
#include <vector>

namespace hybridrt {
namespace {

TEST(BoxFilter, AveragesTheCoveredArea) {
  Image image(4, 2, 1);
  image.data = {0, 1, 2, 3,  //
                4, 5, 6, 7};
  EXPECT_EQ(box_filtered(image, 2, 1).data, (UninitializedVector<float>{2.5f, 4.5f}));
  const Image thirds = box_filtered(image, 3, 1);  // each covers one and a third column
  EXPECT_NEAR(thirds.data[0], (2.0 + 3.0 / 3) / (4.0 / 3), 1e-5);
  EXPECT_NEAR(thirds.data[1], 3.5, 1e-5);
}

TEST(BoxFilter, KeepsTheMeanForAwkwardSizes) {
  Image image(37, 23, 1);
  double sum = 0;
  for (size_t i = 0; i < image.data.size(); ++i) sum += image.data[i] = static_cast<float>(i * 31 % 17);
  for (const auto& [width, height] : {std::pair{5, 7}, std::pair{36, 22}, std::pair{74, 50}}) {
    const Image result = box_filtered(image, width, height);
    double result_sum = 0;
    for (const float value : result.data) result_sum += value;
    EXPECT_NEAR(result_sum / result.data.size(), sum / image.data.size(), 1e-3);
  }
}

TEST(ContactSheet, LaysOutCellsInReadingOrder) {
  std::vector<Image> images;
  for (int i = 0; i < 5; ++i) images.emplace_back(64, 32, 3, static_cast<float>(i + 1));
  images[4] = Image(64, 64, 1, 5.0f);  // higher, and grey
  const Image sheet = contact_sheet(images, 3, 16);
  ASSERT_EQ(sheet.width_px, 3 * 16 + 4 * 4);
  ASSERT_EQ(sheet.height_px, 2 * 16 + 3 * 4) << "cells are as high as the highest thumbnail";
  ASSERT_EQ(sheet.channels, 3);
  for (int i = 0; i < 5; ++i) EXPECT_NEAR(sheet.pixel(4 + i % 3 * 20 + 7, 4 + i / 3 * 20 + 3)[2], i + 1, 1e-5) << i;
  const float background = sheet.pixel(0, 0)[0];
  EXPECT_GT(background, 0);
  EXPECT_LT(background, 0.1f);
  EXPECT_EQ(sheet.pixel(sheet.width_px - 10, sheet.height_px - 10)[0], background) << "no sixth image";
}

TEST(ContactSheet, NoImagesNoSheet) { EXPECT_EQ(contact_sheet({}, 3, 16).pixel_count(), 0u); }

}  // namespace
}  // namespace hybridrt
