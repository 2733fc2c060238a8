// PNGs that we write and read, against OpenImageIO's own reader.

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <random>
#include <zlib.h>

#include "core/base/error.h"
#include "core/image/srgb.h"
#include "core/image_io/png_filter.h"
#include "tests/image_io/encoded_file.h"
#include "tests/image_io/png_variant.h"

namespace hybridrt {
namespace {

struct Oracle {
  bool read = false;
  int width = 0, height = 0, channels = 0;
  std::vector<float> values;
  std::vector<uint8_t> codes;
  std::string description;
};

Oracle by_openimageio(const std::filesystem::path& path) {
  Oracle result;
  OIIO::ImageSpec as_stored;
  as_stored.attribute("oiio:UnassociatedAlpha", 1);
  const auto input = OIIO::ImageInput::create("png");
  OIIO::ImageSpec spec;
  if (!input->open(path.string(), spec, as_stored)) return input->geterror(), result;
  result.width = spec.width, result.height = spec.height, result.channels = spec.nchannels;
  result.values.resize(static_cast<size_t>(spec.width) * spec.height * spec.nchannels);
  result.codes.resize(result.values.size());
  result.description = spec.get_string_attribute("ImageDescription");
  result.read = input->read_image(0, 0, 0, -1, OIIO::TypeFloat, result.values.data());
  if (result.read) result.read = input->read_image(0, 0, 0, -1, OIIO::TypeUInt8, result.codes.data());
  input->geterror();
  return result;
}

std::vector<uint8_t> codes_of(const TexelImage& image, int channels) {
  std::vector<uint8_t> codes;
  for (const uint32_t texel : image.texels)
    for (int c = 0; c < channels; ++c) {
      const int shift = c == alpha_channel(channels) ? 24 : channels < 3 ? 0 : 8 * c;
      codes.push_back(static_cast<uint8_t>(texel >> shift));
    }
  return codes;
}

/// Half of it noise, so that all filters and matches of all lengths are met.
Image half_noise(int width, int height, int channels) {
  Image image = gradient(width, height, channels);
  std::mt19937 random(static_cast<uint32_t>(7 * width + height));
  for (size_t i = image.data.size() / 2; i < image.data.size(); ++i)
    image.data[i] = static_cast<float>(random() % 1000) * 1e-3f;
  return image;
}

TEST(Png, WhatWeWriteIsReadByOpenImageIo) {
  constexpr std::pair<int, int> kSizes[] = {{1, 1},   {1, 9},     {9, 1},     {2, 2},
                                            {61, 43}, {700, 300}, {30000, 3}, {3, 30000}};
  for (const auto& [width, height] : kSizes)
    for (const int channels : {1, 2, 3, 4})
      for (const Compression compression : {Compression::fast, Compression::small}) {
        const Image image = half_noise(width, height, channels);
        const auto bytes = encode_image(image, "png", {{"a", "b"}, {"c", "d e"}}, {compression});
        const EncodedFile file(EncodedFile::as_string(bytes), "png");
        const Oracle read = by_openimageio(file.path);
        ASSERT_TRUE(read.read) << width << 'x' << height;
        ASSERT_EQ(read.channels, channels);
        ASSERT_EQ(read.codes, srgb8_from_linear(image)) << width << 'x' << height << 'x' << channels;
        ASSERT_EQ(read.description, "a=b\nc=d e");
        const Image ours = read_image(file.path);
        ASSERT_TRUE(std::equal(ours.data.begin(), ours.data.end(), read.values.begin(), read.values.end()));
        ASSERT_EQ(read_description(file.path), read.description);
      }
}

TEST(Png, SmallIsSmaller) {
  for (const Image& image : {gradient(300, 200, 3), half_noise(300, 200, 4), Image(300, 200, 3, 0.25f)})
    EXPECT_LT(encode_image(image, "png", {}, {Compression::small}).size(),
              encode_image(image, "png", {}, {Compression::fast}).size());
}

TEST(Png, MoreThanFourChannelsLeaveTheColours) {
  const Image image = gradient(20, 10, 6);
  const Oracle read = by_openimageio(EncodedFile(image, "png").path);
  ASSERT_EQ(read.channels, 3);
  EXPECT_EQ(read.codes[3 * 7 + 2], srgb8_from_linear(image.pixel(7, 0)[2]));
}

TEST(Png, TheFilterOfTheSmallestSumIsTaken) {
  const std::vector<uint8_t> row = {10, 20, 30, 40, 250, 3}, above = {9, 21, 30, 41, 251, 2};
  const PngRow of{row.data(), above.data(), row.size(), 1};
  constexpr PngFilter kBoth[] = {PngFilter::sub, PngFilter::up};
  std::vector<uint8_t> scratch, out(7);
  filter_row_by_sum(of, kBoth, scratch, out.data());
  EXPECT_EQ(out, (std::vector<uint8_t>{2, 1, 255, 0, 255, 255, 1}));
  std::vector<uint8_t> long_row(1000), long_above(1000), long_out(1001);
  for (size_t i = 0; i < long_row.size(); ++i) long_row[i] = static_cast<uint8_t>(i), long_above[i] = 77;
  filter_row_by_sum({long_row.data(), long_above.data(), long_row.size(), 1}, kBoth, scratch, long_out.data());
  EXPECT_EQ(long_out[0], 1) << "each differs from its left by 1";
}

TEST(Png, EveryKindIsReadAsByOpenImageIo) {
  uint32_t seed = 1;
  for (const PngVariant& variant : png_variants())
    for (const auto& [width, height] : {std::pair(1, 1), {13, 7}, {9, 150}}) {
      const EncodedFile file(write_png_variant(variant, width, height, ++seed), "png");
      const Oracle expected = by_openimageio(file.path);
      ASSERT_TRUE(expected.read);
      const Image image = read_image(file.path);
      SCOPED_TRACE(fmt::format("colour type {}, {} bits", variant.color_type, variant.bit_depth));
      ASSERT_EQ(image.width_px, width);
      ASSERT_EQ(image.height_px, height);
      ASSERT_EQ(image.channels, expected.channels);
      ASSERT_TRUE(std::equal(image.data.begin(), image.data.end(), expected.values.begin(), expected.values.end()));
      ASSERT_EQ(codes_of(read_texels(file.path, 1000, 10000), image.channels), expected.codes);
    }
}

TEST(Png, EverySixteenBitNumberIsRoundedAsByOpenImageIo) {
  PngVariant variant{PNG_COLOR_TYPE_GRAY, 16};
  const EncodedFile file(write_png_variant(variant, 1000, 1000, 3), "png");  // nearly all of the 65,536
  const Oracle expected = by_openimageio(file.path);
  const Image image = read_image(file.path);
  ASSERT_TRUE(std::equal(image.data.begin(), image.data.end(), expected.values.begin(), expected.values.end()));
  ASSERT_EQ(codes_of(read_texels(file.path, 1000, 1000000), 1), expected.codes);
}

TEST(Png, DescriptionsOfAllKindsAreFound) {
  for (const int compression : {PNG_TEXT_COMPRESSION_NONE, PNG_TEXT_COMPRESSION_zTXt, PNG_ITXT_COMPRESSION_NONE}) {
    PngVariant variant{PNG_COLOR_TYPE_RGB, 8};
    variant.description = "first=1\nsecond=2", variant.text_compression = compression;
    const EncodedFile file(write_png_variant(variant, 5, 5, 1), "png");
    EXPECT_EQ(read_description(file.path), variant.description);
    EXPECT_EQ(by_openimageio(file.path).description, variant.description);
  }
}

uint32_t number_at(const std::string& bytes, size_t at) {
  uint32_t number = 0;
  for (size_t i = 0; i < 4; ++i) number = number << 8 | static_cast<unsigned char>(bytes[at + i]);
  return number;
}

/// Makes the checksums of all chunks right again, as far as their lengths lead.
void mend_checksums(std::string& bytes) {
  for (size_t at = 8; at + 12 <= bytes.size();) {
    const size_t length = number_at(bytes, at);
    if (length > bytes.size() - at - 12) return;
    const auto sum = crc32(0, reinterpret_cast<const Bytef*>(bytes.data()) + at + 4, static_cast<uInt>(length) + 4);
    for (size_t i = 0; i < 4; ++i) bytes[at + 8 + length + i] = static_cast<char>(sum >> (24 - 8 * i));
    at += 12 + length;
  }
}

// Damage that the checksums do not show: refused and accepted as by OpenImageIO, with the same pixels.
TEST(Png, DamagedFilesAreTakenAsByOpenImageIo) {
  std::mt19937 random(5);
  int refused = 0, taken = 0;
  for (PngVariant variant : png_variants()) {
    variant.description = "d=1";
    const std::string whole = write_png_variant(variant, 11, 9, random());
    for (int trial = 0; trial < 40; ++trial) {
      std::string bytes = whole;
      const size_t place = 8 + random() % (bytes.size() - 8);
      bytes[place] = static_cast<char>(bytes[place] ^ (1u << random() % 8));
      mend_checksums(bytes);
      const EncodedFile file(bytes, "png");
      Image image;
      std::string problem;
      try {
        image = read_image(file.path);
      } catch (const Error& refusal) {
        problem = refusal.what();
      }
      const bool by_checksum = problem.find("cut short") != std::string::npos ||
                               problem.find("checksum") != std::string::npos ||
                               problem.find("too large") != std::string::npos;
      if (by_checksum) continue;           // before any library
      testing::internal::CaptureStderr();  // OpenImageIO's libpng writes there
      const Oracle expected = by_openimageio(file.path);
      testing::internal::GetCapturedStderr();
      ASSERT_EQ(problem.empty(), expected.read) << problem << " at " << place << " of type " << variant.color_type;
      if (!expected.read) {
        ++refused;
        continue;
      }
      ++taken;
      ASSERT_EQ(image.data.size(), expected.values.size());
      ASSERT_TRUE(std::equal(image.data.begin(), image.data.end(), expected.values.begin())) << place;
    }
  }
  EXPECT_GT(refused, 100);
  EXPECT_GT(taken, 100);
}

}  // namespace
}  // namespace hybridrt
