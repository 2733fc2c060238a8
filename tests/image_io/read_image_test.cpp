#include "core/image_io/read_image.h"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <gtest/gtest.h>
#include <iterator>
#include <utility>

#include "core/base/error.h"
#include "core/image/srgb.h"
#include "tests/image_io/encoded_file.h"

namespace hybridrt {
namespace {

void expect_refused(const std::filesystem::path& path, const std::string& word) {
  try {
    read_image(path);
    ADD_FAILURE() << path << " was read";
  } catch (const Error& refusal) {
    EXPECT_EQ(refusal.kind(), ErrorKind::input);
    EXPECT_NE(std::string(refusal.what()).find(path.string()), std::string::npos) << refusal.what();
    EXPECT_NE(std::string(refusal.what()).find(word), std::string::npos) << refusal.what();
    EXPECT_EQ(std::string(refusal.what()).find('\n'), std::string::npos) << refusal.what();
  }
}

/// A BMP header, 24 bits per pixel, that promises more than the file holds.
std::string bmp_header(int32_t width, int32_t height) {
  std::string bytes(54, '\0');
  const auto put = [&](size_t at, int32_t value, int size) {
    for (int i = 0; i < size; ++i) bytes[at + i] = static_cast<char>(value >> (8 * i));
  };
  bytes[0] = 'B', bytes[1] = 'M';
  put(2, 54, 4), put(10, 54, 4), put(14, 40, 4), put(18, width, 4), put(22, height, 4), put(26, 1, 2), put(28, 24, 2);
  return bytes;
}

TEST(ReadImage, LinearDecodesIntegerFormatsOnly) {
  const Image image(4, 4, 4, 0.25f);
  const Image png = read_image_linear(EncodedFile(image, "png").path);
  EXPECT_NEAR(png.data[0], 0.25, 0.003);
  EXPECT_NEAR(png.data[3], 0.25, 0.003) << "alpha takes no curve";
  const Image opaque(4, 4, 3, 0.25f);
  EXPECT_EQ(read_image_linear(EncodedFile(opaque, "exr").path).data, opaque.data);
}

TEST(ReadImage, RowZeroIsOnTop) {
  Image image(2, 3, 3);
  for (int y = 0; y < 3; ++y)
    for (int x = 0; x < 2; ++x) image.pixel(x, y)[0] = y == 0 ? 1.0f : 0.0f;
  for (const char* format : {"png", "bmp", "tga", "tif", "exr"}) {
    const Image back = read_image(EncodedFile(image, format).path);
    EXPECT_EQ(back.pixel(1, 0)[0], 1) << format;
    EXPECT_EQ(back.pixel(1, 2)[0], 0) << format;
  }
}

TEST(ReadImage, TallImagesAreReadInStripsWithoutSeams) {
  const Image image = gradient(5, 200, 3);
  EXPECT_EQ(read_image(EncodedFile(image, "exr").path).data, image.data);
}

TEST(ReadImage, WrongExtensionsAreSeenThrough) {
  const Image image = gradient(20, 10, 3);
  for (const char* format : {"png", "exr", "bmp"}) {
    const std::string bytes = EncodedFile::as_string(encode_image(image, format));
    for (const char* extension : {"jpg", "tga", "xyz"})
      EXPECT_EQ(read_image(EncodedFile(bytes, extension).path).data, read_image(EncodedFile(bytes, format).path).data)
          << format << " called " << extension;
  }
}

TEST(ReadImage, RefusesWhatIsNoImage) {
  expect_refused("/nowhere/a.png", "no such image");
  expect_refused(std::filesystem::temp_directory_path(), "folder");
  expect_refused("/dev/zero", "device");
  expect_refused(EncodedFile("", "png").path, "not a readable image");
  expect_refused(EncodedFile("", "null").path, "not a readable image");
  std::string noise(5000, '\0');
  for (size_t i = 0; i < noise.size(); ++i) noise[i] = static_cast<char>(i * 2654435761u >> 13);
  for (const char* extension : {"png", "jpg", "exr", "tif", "hdr", "tga", "xyz"})
    expect_refused(EncodedFile(noise, extension).path, extension);
}

std::string uncompressed_tiff(const Image& image) {
  const EncodedFile file(std::string(), "tif");
  OIIO::ImageSpec spec(image.width_px, image.height_px, image.channels, OIIO::TypeUInt8);
  spec.attribute("compression", "none");
  const auto writer = OIIO::ImageOutput::create("tif");
  EXPECT_TRUE(writer->open(file.path.string(), spec) && writer->write_image(OIIO::TypeFloat, image.data.data()) &&
              writer->close());
  std::ifstream written(file.path, std::ios::binary);
  return {std::istreambuf_iterator<char>(written), {}};
}

// Some decoders report success and leave the rest grey or black.
TEST(ReadImage, RefusesFilesCutShort) {
  constexpr int kWidth_px = 200, kHeight_px = 150;
  const Image image = gradient(kWidth_px, kHeight_px, 3);
  std::vector<std::pair<std::string, std::string>> files = {{"tif", uncompressed_tiff(image)}};
  for (const char* format : {"png", "exr", "bmp", "jpg", "tga", "tif", "gif", "hdr", "jp2", "webp", "ppm", "fits"})
    files.emplace_back(format, EncodedFile::as_string(encode_image(image, format)));
  for (const auto& [format, bytes] : files) {
    const TexelImage whole = read_texels(EncodedFile(bytes, format).path, 1000, 100'000);
    EXPECT_EQ(whole.damage, "") << format;
    for (const size_t tenths : {3, 6, 9}) {
      const EncodedFile cut(bytes.substr(0, bytes.size() * tenths / 10), format);
      expect_refused(cut.path, format);
      if (format != "jpg") {
        EXPECT_THROW(read_texels(cut.path, 1000, 100'000), Error) << format;
        continue;
      }
      const TexelImage texels = read_texels(cut.path, 1000, 100'000);
      EXPECT_EQ(texels.damage, "JPEG error: Premature end of JPEG file");
      const auto [there, not_there] = std::mismatch(whole.texels.begin(), whole.texels.end(), texels.texels.begin());
      EXPECT_GE(there - whole.texels.begin(), kWidth_px * kHeight_px * (static_cast<int>(tenths) - 2) / 10);
      EXPECT_NE(there, whole.texels.end());
    }
  }
}

// libpng would report them on standard error.
TEST(ReadImage, DamagedPngsAreToldOfByUs) {
  const std::string bytes = EncodedFile::as_string(encode_image(gradient(20, 20, 3), "png"));
  testing::internal::CaptureStderr();
  for (size_t size = 8; size < bytes.size(); size += 7)
    expect_refused(EncodedFile(bytes.substr(0, size), "png").path, "it is cut short");
  for (size_t place : {size_t{20}, bytes.size() / 2, bytes.size() - 2}) {
    std::string damaged = bytes;
    damaged[place] = static_cast<char>(damaged[place] ^ 4);
    expect_refused(EncodedFile(damaged, "png").path, "checksum");
  }
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
}

TEST(ReadImage, RefusesHugeSizesBeforeAllocating) {
  expect_refused(EncodedFile(bmp_header(65501, 1), "bmp").path, "too large");
  expect_refused(EncodedFile(bmp_header(1, 65501), "bmp").path, "too large");
  expect_refused(EncodedFile(bmp_header(40000, 40000), "bmp").path, "too large");
  expect_refused(EncodedFile(bmp_header(30000, 30000), "bmp").path, "broken image");
}

constexpr uint64_t kMany = 1 << 20;

TEST(ReadTexels, GivesDisplayCodesOfEveryFormat) {
  const Image image = gradient(9, 150, 3);  // more rows than a strip
  const std::vector<uint8_t> codes = srgb8_from_linear(image);
  for (const char* format : {"png", "bmp", "tga", "tif", "exr"}) {
    const TexelImage texels = read_texels(EncodedFile(image, format).path, 1000, kMany);
    EXPECT_FALSE(texels.has_alpha);
    ASSERT_EQ(texels.texels.size(), image.pixel_count()) << format;
    for (size_t i = 0; i < image.pixel_count(); ++i)
      ASSERT_EQ(texels.texels[i], codes[3 * i] | codes[3 * i + 1] << 8 | codes[3 * i + 2] << 16 | 0xFF000000u)
          << format << ' ' << i;
  }
}

TEST(ReadTexels, GreyAndAlpha) {
  Image image(2, 1, 4);
  image.data = {1, 0, 0, 0.5f, 1, 1, 0, 0};
  const TexelImage texels = read_texels(EncodedFile(image, "png").path, 10, 10);
  EXPECT_TRUE(texels.has_alpha);
  EXPECT_EQ(texels.texels, (std::vector<uint32_t>{0x800000FFu, 0x0000FFFFu})) << "not multiplied by alpha";
  EXPECT_EQ(read_texels(EncodedFile(Image(1, 1, 1, 1.0f), "png").path, 10, 10).texels[0], 0xFFFFFFFFu);
}

/// One row of pixels, blue first; `masks` where `compression` wants some.
std::string bmp_of(uint32_t header_bytes, uint32_t compression, std::vector<uint32_t> masks,
                   const std::string& pixels) {
  std::string bytes = "BM";
  const auto add = [&](uint32_t value, int count) {
    for (int i = 0; i < count; ++i) bytes += static_cast<char>(value >> 8 * i & 255);
  };
  const auto begin = 14 + std::max(header_bytes, 40 + 4 * static_cast<uint32_t>(masks.size()));
  add(begin + static_cast<uint32_t>(pixels.size()), 4), add(0, 4), add(begin, 4);
  add(header_bytes, 4), add(static_cast<uint32_t>(pixels.size() / 4), 4), add(1, 4), add(1, 2), add(32, 2);
  add(compression, 4), add(static_cast<uint32_t>(pixels.size()), 4);
  for (int i = 0; i < 4; ++i) add(0, 4);
  for (uint32_t mask : masks) add(mask, 4);
  bytes.resize(begin);
  return bytes + pixels;
}

std::string tga_of(char alpha_bits, const std::string& pixels) {
  std::string bytes(18, '\0');
  bytes[2] = 2, bytes[12] = static_cast<char>(pixels.size() / 4), bytes[14] = 1, bytes[16] = 32, bytes[17] = alpha_bits;
  return bytes + pixels;
}

TEST(ReadTexels, AlphaThatTheFormatCallsUnusedIsOpaque) {
  const std::string pixels("\x10\x20\x30\x00\x40\x50\x60\x80", 8);
  const std::vector<uint32_t> opaque = {0xFF102030u, 0xFF405060u};
  for (const std::string& bytes :
       {bmp_of(40, 0, {}, pixels), bmp_of(108, 0, {0xFF0000, 0xFF00, 0xFF, 0xFF000000}, pixels)}) {
    const TexelImage texels = read_texels(EncodedFile(bytes, "bmp").path, 10, 10);
    EXPECT_FALSE(texels.has_alpha);
    EXPECT_EQ(texels.texels, opaque);
  }
  EXPECT_EQ(read_texels(EncodedFile(tga_of(0, pixels), "tga").path, 10, 10).texels, opaque);
  const TexelImage used = read_texels(EncodedFile(tga_of(8, pixels), "tga").path, 10, 10);
  EXPECT_TRUE(used.has_alpha);
  EXPECT_EQ(used.texels, (std::vector<uint32_t>{0x00102030u, 0x80405060u}));

  const std::string extension = std::string(494, '\0') + std::string(1, '\2');
  const std::string footer = std::string("\x1A\0\0\0\0\0\0\0", 8) + "TRUEVISION-XFILE." + std::string(1, '\0');
  const TexelImage undefined = read_texels(EncodedFile(tga_of(8, pixels) + extension + footer, "tga").path, 10, 10);
  EXPECT_EQ(undefined.texels[0], 0xFF102030u) << "the extension calls it undefined";
}

TEST(ReadTexels, RefusesWhatIsTooLargeBeforeItIsRead) {
  const EncodedFile huge(bmp_header(65000, 16000), "bmp");
  EXPECT_THROW(read_texels(huge.path, 16384, uint64_t{1} << 40), Error);
  const EncodedFile small(gradient(8, 8, 3), "png");
  EXPECT_NO_THROW(read_texels(small.path, 8, 64));
  EXPECT_THROW(read_texels(small.path, 7, 64), Error);
  EXPECT_THROW(read_texels(small.path, 8, 63), Error);
  EXPECT_THROW(read_texels(EncodedFile(std::string("no picture"), "png").path, 8, 64), Error);
}

}  // namespace
}  // namespace hybridrt
