#include "core/render/frame.h"

#include <gtest/gtest.h>

#include "core/base/error.h"

namespace hybridrt {
namespace {

TEST(PictureFromRgba, SplitsOffAndCountsWhatSeesASurface) {
  const std::vector<vec4> rgba = {{1, 2, 3, 1}, {4, 5, 6, 0}, {7, 8, 9, 2}, {0, 0, 0, 0}, {-1, 0, 1, 2}, {2, 2, 2, 0}};
  TraceStats stats;
  const Image picture = picture_from_rgba(rgba.data(), 3, 2, {0, 0, 3, 2}, false, stats);
  EXPECT_EQ(stats.pixels_hit, 3);
  EXPECT_EQ(stats.pixels_lit, 2);
  EXPECT_EQ(picture.width_px, 3);
  EXPECT_EQ(picture.height_px, 2);
  EXPECT_EQ(picture.channels, 3);
  EXPECT_EQ(picture.pixel(2, 0)[1], 8);
  EXPECT_EQ(picture.pixel(1, 1)[0], -1);
}

TEST(PictureFromRgba, AlphaTakesTheBackgroundsPlace) {
  const std::vector<vec4> rgba = {{1, 2, 3, 1}, {4, 5, 6, 0}, {7, 8, 9, 2}};
  TraceStats stats;
  const Image picture = picture_from_rgba(rgba.data(), 3, 1, {0, 0, 3, 1}, true, stats);
  EXPECT_EQ(picture.channels, 4);
  EXPECT_EQ(picture.data, (UninitializedVector<float>{1, 2, 3, 1, 0, 0, 0, 0, 7, 8, 9, 1}));
}

TEST(PictureFromRgba, PixelsThatWereNeverWrittenThrow) {
  for (float alpha :
       {0.5f, -1.0f, 3.0f, std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity()}) {
    std::vector<vec4> rgba(6, vec4(0, 0, 0, 1));
    rgba[4].a = alpha;
    TraceStats stats;
    try {
      picture_from_rgba(rgba.data(), 3, 2, {0, 0, 3, 2}, false, stats);
      ADD_FAILURE() << alpha << " was accepted";
    } catch (const Error& failure) {
      EXPECT_EQ(failure.kind(), ErrorKind::device);
    }
  }
}

}  // namespace
}  // namespace hybridrt
