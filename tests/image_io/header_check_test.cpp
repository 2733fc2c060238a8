#include "core/image_io/header_check.h"

#include <cstdio>
#include <fstream>
#include <gtest/gtest.h>

#include "core/base/error.h"
#include "core/image_io/encode_image.h"
#include "core/image_io/read_image.h"
#include "tests/image_io/encoded_file.h"

namespace hybridrt {
namespace {

constexpr int kSide_px = 16384;
constexpr uint64_t kTexels = 1 << 27;

std::string little(uint64_t value, int bytes) {
  std::string text;
  for (int i = 0; i < bytes; ++i) text += static_cast<char>(value >> 8 * i & 255);
  return text;
}

std::string big(uint64_t value, int bytes) {
  const std::string text = little(value, bytes);
  return {text.rbegin(), text.rend()};
}

HeaderClaim claim_of(const std::string& bytes, uint64_t most_texels = kTexels) {
  const std::string path = testing::TempDir() + "/hybridrt_header";
  std::ofstream(path, std::ios::binary) << bytes;
  HeaderClaim claim = header_claim(path, {kSide_px, most_texels});
  std::remove(path.c_str());
  return claim;
}

std::string fault_of(const std::string& bytes, uint64_t most_texels = kTexels) {
  return claim_of(bytes, most_texels).fault;
}

std::string codestream(uint64_t width, uint64_t height, uint64_t components, uint64_t tile = 1 << 20) {
  return big(0xFF4FFF51, 4) + big(38 + 3 * components, 2) + big(0, 2) + big(width, 4) + big(height, 4) + big(0, 8) +
         big(tile, 4) + big(tile, 4) + big(0, 8) + big(components, 2) + std::string(3 * components, '\1');
}

std::string exr(const std::string& attributes) { return little(20000630, 4) + little(2, 4) + attributes + '\0'; }

std::string attribute(const std::string& name, const std::string& type, const std::string& value, uint64_t claimed) {
  std::string text = name;
  text += '\0';
  text += type;
  text += '\0';
  return text + little(claimed, 4) + value;
}

std::string attribute(const std::string& name, const std::string& type, const std::string& value) {
  return attribute(name, type, value, value.size());
}

bool has(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

TEST(HeaderCheck, PicturesThatWeWritePass) {
  for (const char* format : {"png", "jpg", "tif", "bmp", "exr", "gif", "jp2", "hdr", "tga"}) {
    if (!can_write_format(format)) continue;
    const EncodedFile file(Image(64, 48, 3, 0.5f), format);
    EXPECT_EQ(header_claim(file.path, {kSide_px, kTexels}).fault, "") << format;
    EXPECT_EQ(header_claim(file.path, {64, 64 * 48}).fault, "") << format;
    const TexelSize size = texel_size(file.path, 64, 64 * 48);
    EXPECT_EQ(size.width_px, 64) << format;
    EXPECT_EQ(size.height_px, 48) << format;
    EXPECT_GE(size.decoding_bytes, 64u * 48 * (4 + 1)) << format;
    EXPECT_LE(size.decoding_bytes, 64u * 48 * 80) << format;
    EXPECT_THROW(texel_size(file.path, 63, 64 * 48), Error) << format;
    EXPECT_THROW(texel_size(file.path, 64, 64 * 48 - 1), Error) << format;
  }
}

TEST(HeaderCheck, Jpeg2000) {
  EXPECT_EQ(fault_of(codestream(4096, 4096, 3)), "");
  EXPECT_TRUE(has(fault_of(codestream(16385, 8, 3)), "16385x8 pixels are too large"));
  EXPECT_TRUE(has(fault_of(codestream(16000, 16000, 3)), "16000x16000"));
  EXPECT_TRUE(has(fault_of(codestream(4096, 4096, 16384)), "16384 components"));
  EXPECT_TRUE(has(fault_of(codestream(4096, 4096, 3), 4096 * 4096), "takes"))
      << "no room left: most of it is the decoder's";
  EXPECT_TRUE(has(fault_of(codestream(4096, 4096, 1000, 16), 1 << 24), "tiles"));
  const std::string jp2 =
      big(0x0000000C6A502020, 8) + big(0x0D0A870A, 4) + big(20, 4) + "jp2h" + std::string(12, 'x') + big(0, 4) + "jp2c";
  EXPECT_EQ(fault_of(jp2 + codestream(64, 64, 3)), "");
  EXPECT_TRUE(has(fault_of(jp2 + codestream(16000, 16000, 3)), "16000x16000"));
  EXPECT_TRUE(has(fault_of(jp2 + big(0xFF4FFF64, 4)), "does not begin with a size"));
}

TEST(HeaderCheck, Gif) {
  EXPECT_EQ(fault_of("GIF89a" + little(640, 2) + little(480, 2)), "");
  EXPECT_TRUE(has(fault_of("GIF89a" + little(65535, 2) + little(65535, 2)), "65535x65535"));
}

// An otherwise whole progressive file of 545 bytes made libjpeg take 10 GB.
TEST(HeaderCheck, Jpeg) {
  const std::string start = big(0xFFD8, 2), comment = big(0xFFFE, 2) + big(6, 2) + big(0xFFC2, 2) + "xx";
  const auto frame = [](uint64_t code, uint64_t width, uint64_t height) {
    return big(code, 2) + big(17, 2) + big(8, 1) + big(height, 2) + big(width, 2) + big(3, 1) + std::string(9, '\1');
  };
  for (const uint64_t code : {0xFFC0, 0xFFC1, 0xFFC2, 0xFFCA}) {
    const HeaderClaim claim = claim_of(start + comment + frame(code, 4000, 3000));
    EXPECT_EQ(claim.fault, "");
    EXPECT_EQ(claim.width_px, 4000u);
    EXPECT_EQ(claim.height_px, 3000u);
    EXPECT_GE(claim.decoding_bytes, 4000u * 3000 * (4 + 3 * 2));
    EXPECT_TRUE(has(fault_of(start + comment + frame(code, 60000, 60000)), "60000x60000 pixels are too large"));
  }
  const std::string tables = big(0xFFC4, 2) + big(19, 2) + std::string(17, '\0');
  EXPECT_TRUE(has(fault_of(start + tables + std::string(5000, 'x') + "\xFF" + frame(0xFFC2, 60000, 8)), "60000x8"))
      << "bytes between segments, and more than one 0xFF, are passed over as libjpeg does";
  EXPECT_EQ(fault_of(start + big(0xFFDA, 2) + frame(0xFFC2, 60000, 8)), "") << "after a scan none is read";
}

TEST(HeaderCheck, Exr) {
  const auto window = [](int width, int height) {
    return attribute("dataWindow", "box2i", little(0, 8) + little(width - 1, 4) + little(height - 1, 4));
  };
  EXPECT_EQ(fault_of(exr(window(640, 480))), "");
  EXPECT_TRUE(has(fault_of(exr(window(640, 1 << 30))), "too large"));
  EXPECT_TRUE(has(fault_of(exr(attribute("x", "string", "", 0x7FFFFFFF))), "attribute 'x' claims 2147483647 bytes"));
  EXPECT_TRUE(
      has(fault_of(exr(attribute("preview", "preview", little(40000, 4) + little(40000, 4)))), "preview of 40000x"));
  EXPECT_EQ(fault_of(exr(attribute("preview", "preview", little(1, 4) + little(1, 4) + "rgba"))), "");
  const auto tiled = [&](int size, uint64_t tile_px) {
    return exr(window(size, size) + attribute("tiles", "tiledesc", little(tile_px, 4) + little(tile_px, 4) + '\0'));
  };
  EXPECT_EQ(fault_of(tiled(100, 64)), "");
  EXPECT_TRUE(
      has(fault_of(exr(window(64, 64) + attribute("tiles", "box2i", little(64, 4) + little(0, 4)))), "no pixels"));
  EXPECT_TRUE(has(fault_of(tiled(16000, 1)), "256000000 chunks in a file of"));
  EXPECT_TRUE(has(fault_of(tiled(16000, 16000)), "tiles of 16000x16000 pixels are too large"));
  EXPECT_TRUE(has(fault_of(exr(window(64, 64) + attribute("chunkCount", "int", little(0x7FFFFFFF, 4)))), "chunks"));
}

}  // namespace
}  // namespace hybridrt
