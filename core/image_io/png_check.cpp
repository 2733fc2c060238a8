#include "core/image_io/png_check.h"

#include <algorithm>
#include <cstdint>
#include <fstream>
#include <libdeflate.h>
#include <string_view>
#include <vector>

#include "core/image_io/file_bytes.h"

namespace hybridrt {
namespace {

constexpr const char* kCutShort = "it is cut short";
constexpr std::string_view kSignature = "\x89PNG\r\n\x1a\n";

uint32_t big_endian(const unsigned char* bytes) {
  return uint32_t{bytes[0]} << 24 | uint32_t{bytes[1]} << 16 | uint32_t{bytes[2]} << 8 | bytes[3];
}

}  // namespace

bool is_png(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  char head[8];
  return file.read(head, sizeof head) && std::string_view(head, sizeof head) == kSignature;
}

std::string png_length_fault(const std::filesystem::path& path) {
  constexpr uint64_t kChunkBytes = 12;  // length, type, checksum
  FileBytes file(path);
  for (uint64_t place = kSignature.size(); place + kChunkBytes <= file.size();) {
    const uint64_t length = file.big(place, 4);
    if (length > file.size() - place - kChunkBytes) break;
    if (file.at(place + 4, 4) == "IEND") return "";
    place += kChunkBytes + length;
  }
  return kCutShort;
}

std::string png_fault(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  const auto read = [&](unsigned char* to, size_t count) {
    return static_cast<bool>(file.read(reinterpret_cast<char*>(to), static_cast<std::streamsize>(count)));
  };
  unsigned char head[8];
  if (!read(head, 8)) return kCutShort;

  std::vector<unsigned char> block(size_t{1} << 16);
  for (;;) {  // a chunk: length, type, contents, checksum of type and contents
    if (!read(head, 8)) return kCutShort;
    const std::string_view type(reinterpret_cast<const char*>(head) + 4, 4);
    uint32_t sum = libdeflate_crc32(0, head + 4, 4);
    for (size_t left = big_endian(head); left > 0;) {
      const size_t count = std::min(left, block.size());
      if (!read(block.data(), count)) return kCutShort;
      sum = libdeflate_crc32(sum, block.data(), count);
      left -= count;
    }
    unsigned char stored[4];
    if (!read(stored, 4)) return kCutShort;
    if (big_endian(stored) != sum) return "a checksum in it is wrong";
    if (type == "IEND") return "";
  }
}

}  // namespace hybridrt
