#include "core/image_io/encode_image.h"

#include <chrono>
#include <cmath>
#include <future>
#include <gtest/gtest.h>
#include <limits>
#include <map>
#include <thread>

#include "core/base/error.h"
#include "core/image/srgb.h"
#include "core/image_io/read_image.h"
#include "tests/image_io/encoded_file.h"

namespace hybridrt {
namespace {

const ImageMetadata kMetadata = {{"version", "1.2.3"}, {"fingerprint", "a=b; \xC3\xA4"}};

TEST(EncodeImage, PngHoldsTheSrgbCodesExactly) {
  for (const int channels : {1, 2, 3, 4}) {
    const Image image = gradient(61, 43, channels);
    const Image back = read_image(EncodedFile(image, "png").path);
    ASSERT_EQ(back.channels, channels);
    const std::vector<uint8_t> expected = srgb8_from_linear(image);
    for (size_t i = 0; i < expected.size(); ++i) ASSERT_EQ(std::lround(back.data[i] * 255), expected[i]) << i;
  }
}

TEST(EncodeImage, PngFollowsTheCurveByTheNearestCode) {
  Image image(4, 1, 3);
  image.data = {0, 0.5f, 1, -3, 7, 0.18f, 0.0031308f, 0.002f, 0.0001f, 0.25f, 0.75f, 0.9999f};
  const Image back = read_image(EncodedFile(image, "png").path);
  const int expected[] = {0, 188, 255, 0, 255, 118, 10, 7, 0, 137, 225, 255};
  for (size_t i = 0; i < back.data.size(); ++i) EXPECT_EQ(std::lround(back.data[i] * 255), expected[i]) << i;
}

/// An EXR's channel list: names and pixel types (0 whole numbers, 2 floats).
std::map<std::string, int> exr_channels(const std::string& file) {
  const std::string start("channels\0chlist\0", 16);
  size_t at = file.find(start) + start.size() + 4;
  std::map<std::string, int> channels;
  while (file[at] != 0) {
    const std::string name = file.c_str() + at;
    at += name.size() + 1;
    channels[name] = file[at];
    at += 16;
  }
  return channels;
}

TEST(EncodeImage, ExrHasTheLayersAsChannels) {
  Image image = gradient(31, 17, 3);
  const size_t pixels = image.pixel_count();
  ImageLayer id{"id", {"id"}, {}, {}}, normal{"normal", {"N.X", "N.Y", "N.Z"}, {}, {}};
  for (size_t i = 0; i < pixels; ++i) id.numbers.push_back(i == 0 ? 0xFFFFFFFFu : static_cast<uint32_t>(16777217 + i));
  for (size_t i = 0; i < 3 * pixels; ++i) normal.values.push_back(-1 + static_cast<float>(i) / pixels);
  image.layers = {id, normal};
  const std::vector<unsigned char> bytes = encode_image(image, "exr");
  EXPECT_EQ(bytes, encode_image(image, "exr"));
  const std::string file = EncodedFile::as_string(bytes);
  const std::map<std::string, int> expected = {{"R", 2},   {"G", 2},   {"B", 2},  {"id", 0},
                                               {"N.X", 2}, {"N.Y", 2}, {"N.Z", 2}};
  EXPECT_EQ(exr_channels(file), expected);
  const Image back = read_image(EncodedFile(file, "exr").path);
  ASSERT_EQ(back.channels, 7);
  for (size_t i = 0; i < pixels; ++i)
    for (size_t c = 0; c < 3; ++c) {
      ASSERT_EQ(back.data[7 * i + c], image.data[3 * i + c]);
      ASSERT_EQ(back.data[7 * i + 4 + c], normal.values[3 * i + c]);
    }
  EXPECT_TRUE(keeps_layers("a.exr"));
  EXPECT_FALSE(keeps_layers("a.png"));
  EXPECT_EQ(read_image(EncodedFile(image, "png").path).channels, 3) << "left out where there is no room";
  image.layers[1].values[5] = std::numeric_limits<float>::infinity();
  EXPECT_THROW(encode_image(image, "exr"), Error);
}

TEST(EncodeImage, ExrIsExact) {
  for (const int channels : {1, 3, 6}) {
    Image image = gradient(61, 43, channels);
    image.data[0] = -2.5f, image.data[1] = 1e20f, image.data[2] = 1e-20f;
    const EncodedFile file(image, "exr");
    EXPECT_EQ(read_image(file.path).data, image.data);
    EXPECT_EQ(read_image_linear(file.path).data, image.data);
  }
}

TEST(EncodeImage, TiffAndBmpAndTargaHoldTheCodesExactly) {
  const Image image = gradient(61, 43, 3);
  const std::vector<uint8_t> expected = srgb8_from_linear(image);
  for (const char* format : {"tif", "bmp", "tga", "ppm", "webp"}) {
    const Image back = read_image(EncodedFile(image, format).path);
    ASSERT_EQ(back.data.size(), expected.size()) << format;
    int worst = 0;
    for (size_t i = 0; i < expected.size(); ++i)
      worst = std::max<int>(worst, std::abs(static_cast<int>(std::lround(back.data[i] * 255)) - expected[i]));
    EXPECT_LE(worst, std::string(format) == "webp" ? 30 : 0) << format;
  }
}

TEST(EncodeImage, JpegIsClose) {
  const Image image = gradient(64, 48, 3);
  const Image back = read_image_linear(EncodedFile(image, "jpg").path);
  ASSERT_EQ(back.data.size(), image.data.size());
  double sum = 0;
  for (size_t i = 0; i < image.data.size(); ++i) sum += std::abs(back.data[i] - image.data[i]);
  EXPECT_LT(sum / image.data.size(), 0.02);
}

TEST(EncodeImage, HdrKeepsBrightLinearValues) {
  const Image back = read_image(EncodedFile(Image(32, 8, 1, 20.0f), "hdr").path);
  ASSERT_EQ(back.channels, 3) << "grey becomes colour";
  for (const float value : back.data) EXPECT_NEAR(value, 20, 0.1);
}

TEST(EncodeImage, AlphaGoesWhereTheFormatTakesItAndColoursStayUnmultiplied) {
  Image image(2, 2, 4, 0.5f);
  const Image png = read_image(EncodedFile(image, "png").path);
  EXPECT_EQ(std::lround(png.data[0] * 255), 188);
  EXPECT_EQ(std::lround(png.data[3] * 255), 128);
  EXPECT_EQ(read_image(EncodedFile(image, "jpg").path).channels, 3);
  EXPECT_EQ(std::lround(read_image(EncodedFile(image, "tif").path).data[0] * 255), 188);
  const Image exr = read_image(EncodedFile(image, "exr").path);
  EXPECT_EQ(exr.data, UninitializedVector<float>({0.25f, 0.25f, 0.25f, 0.5f, 0.25f, 0.25f, 0.25f, 0.5f, 0.25f, 0.25f,
                                                  0.25f, 0.5f, 0.25f, 0.25f, 0.25f, 0.5f}))
      << "times alpha";
  for (const char* format : {"png", "tif", "exr"}) EXPECT_TRUE(keeps_alpha(format)) << format;
  EXPECT_FALSE(keeps_alpha("jpg"));
}

// Every writer: whole files, readable again, the same bytes again, more than a second later (no time in
// them) and from several threads at once.
TEST(EncodeImage, EqualImagesGiveEqualBytesInEveryFormat) {
  const std::vector<std::string> formats = {"png", "exr", "tif",  "jpg", "bmp", "tga",
                                            "hdr", "ppm", "webp", "jp2", "gif", "fits"};
  const Image image = gradient(131, 97, 3);
  std::map<std::string, std::vector<unsigned char>> first;
  for (const std::string& format : formats) {
    ASSERT_TRUE(can_write_format(format)) << format;
    first[format] = encode_image(image, format, kMetadata);
  }
  std::this_thread::sleep_for(std::chrono::milliseconds(1100));

  std::vector<std::future<void>> encoders;
  for (int thread = 0; thread < 4; ++thread)
    encoders.push_back(std::async(std::launch::async, [&] {
      for (const std::string& format : formats)
        EXPECT_EQ(encode_image(image, format, kMetadata) == first[format], true) << format;
    }));
  for (std::future<void>& encoder : encoders) encoder.get();

  for (const std::string& format : formats) {
    const std::string bytes(first[format].begin(), first[format].end());
    EXPECT_EQ(bytes.find("OpenImageIO"), std::string::npos) << format;
    const Image back = read_image(EncodedFile(image, format).path);
    EXPECT_EQ(back.width_px, image.width_px) << format;
    EXPECT_EQ(back.height_px, image.height_px) << format;
  }
}

TEST(EncodeImage, MetadataComesBack) {
  for (const char* format : {"png", "exr", "tif", "jpg", "tga"})
    EXPECT_EQ(read_image_metadata(EncodedFile(gradient(8, 8, 3), format, kMetadata).path), kMetadata) << format;
  EXPECT_TRUE(read_image_metadata(EncodedFile(gradient(8, 8, 3), "png").path).empty());
}

TEST(EncodeImage, RefusesNonFiniteValues) {
  for (const float bad : {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity()})
    for (const char* format : {"png", "exr"}) {
      Image image = gradient(8, 8, 3);
      image.pixel(3, 5)[2] = bad;
      try {
        encode_image(image, format);
        ADD_FAILURE() << format << " took " << bad;
      } catch (const Error& refusal) {
        EXPECT_EQ(refusal.kind(), ErrorKind::output);
        EXPECT_NE(std::string(refusal.what()).find("pixel (3, 5), channel 2"), std::string::npos) << refusal.what();
      }
    }
}

TEST(EncodeImage, KnowsWhatCannotBeWritten) {
  for (const char* name : {"png", ".png", "PNG", "out/a.0001.exr", "a.b/c.JPG", "tif", "tiff"})
    EXPECT_TRUE(can_write_format(name)) << name;
  for (const char* name : {"", ".", "xyz", "out/name", "out.png/name", "null", "a.null", "term", "txt", "psd", "sgi",
                           "dpx", "rla", "heic", "/"})
    EXPECT_FALSE(can_write_format(name)) << name;
  EXPECT_NO_THROW(require_writable_format("out/a.png"));
  try {
    require_writable_format("out/a.xyz");
    ADD_FAILURE();
  } catch (const Error& refusal) {
    EXPECT_EQ(refusal.kind(), ErrorKind::usage);
    EXPECT_NE(std::string(refusal.what()).find("out/a.xyz"), std::string::npos);
  }
}

TEST(EncodeImage, SaysWhenTheFormatIsTooSmall) {
  try {
    encode_image(Image(20000, 2, 3), "webp");  // ends at 16383 pixels
    ADD_FAILURE();
  } catch (const Error& refusal) {
    EXPECT_EQ(refusal.kind(), ErrorKind::output);
    EXPECT_EQ(std::string(refusal.what()).find('\n'), std::string::npos);
  }
}

}  // namespace
}  // namespace hybridrt
