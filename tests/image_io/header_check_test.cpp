#include "core/image_io/header_check.h"

#include <cstdio>
#include <fstream>
#include <gtest/gtest.h>

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

std::string fault_of(const std::string& bytes, uint64_t most_texels = kTexels) {
  const std::string path = testing::TempDir() + "/hybridrt_header";
  std::ofstream(path, std::ios::binary) << bytes;
  const std::string fault = header_fault(path, kSide_px, most_texels);
  std::remove(path.c_str());
  return fault;
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
    EXPECT_EQ(header_fault(file.path, kSide_px, kTexels), "") << format;
    EXPECT_EQ(header_fault(file.path, 64, 64 * 48), "") << format;
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
}

}  // namespace
}  // namespace hybridrt
