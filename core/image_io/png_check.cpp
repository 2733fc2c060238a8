#include "core/image_io/png_check.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <fstream>
#include <string_view>
#include <vector>

namespace hybridrt {
namespace {

constexpr std::string_view kSignature = "\x89PNG\r\n\x1a\n";

/// The checksum of PNG's specification, annex D.
class Crc {
 public:
  Crc() {
    for (uint32_t n = 0; n < 256; ++n) {
      uint32_t c = n;
      for (int bit = 0; bit < 8; ++bit) c = c & 1 ? 0xEDB88320u ^ c >> 1 : c >> 1;
      table_[n] = c;
    }
  }
  uint32_t operator()(const unsigned char* bytes, size_t count, uint32_t crc) const {
    for (size_t i = 0; i < count; ++i) crc = table_[(crc ^ bytes[i]) & 255] ^ crc >> 8;
    return crc;
  }

 private:
  std::array<uint32_t, 256> table_;
};

uint32_t big_endian(const unsigned char* bytes) {
  return uint32_t{bytes[0]} << 24 | uint32_t{bytes[1]} << 16 | uint32_t{bytes[2]} << 8 | bytes[3];
}

}  // namespace

std::string png_fault(const std::filesystem::path& path) {
  static const Crc crc;
  constexpr const char* kCutShort = "it is cut short";
  std::ifstream file(path, std::ios::binary);
  const auto read = [&](unsigned char* to, size_t count) {
    return static_cast<bool>(file.read(reinterpret_cast<char*>(to), static_cast<std::streamsize>(count)));
  };
  unsigned char head[8];
  if (!read(head, 8) || !std::equal(head, head + 8, reinterpret_cast<const unsigned char*>(kSignature.data())))
    return "";

  std::vector<unsigned char> block(size_t{1} << 16);
  for (;;) {  // a chunk: length, type, contents, checksum of type and contents
    if (!read(head, 8)) return kCutShort;
    const std::string_view type(reinterpret_cast<const char*>(head) + 4, 4);
    uint32_t sum = crc(head + 4, 4, 0xFFFFFFFFu);
    for (size_t left = big_endian(head); left > 0;) {
      const size_t count = std::min(left, block.size());
      if (!read(block.data(), count)) return kCutShort;
      sum = crc(block.data(), count, sum);
      left -= count;
    }
    unsigned char stored[4];
    if (!read(stored, 4)) return kCutShort;
    if (big_endian(stored) != ~sum) return "a checksum in it is wrong";
    if (type == "IEND") return "";
  }
}

}  // namespace hybridrt
