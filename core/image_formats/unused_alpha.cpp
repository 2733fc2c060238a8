#include "core/image_formats/unused_alpha.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <fstream>

namespace hybridrt {
namespace {

using Bytes = std::array<unsigned char, 70>;

uint32_t word32(const Bytes& bytes, size_t at) {
  return bytes[at] | uint32_t{bytes[at + 1]} << 8 | uint32_t{bytes[at + 2]} << 16 | uint32_t{bytes[at + 3]} << 24;
}

/// Masks are given with BI_BITFIELDS or BI_ALPHABITFIELDS, that of alpha at byte 66 of the file.
bool bmp_lacks_alpha(const Bytes& header) {
  constexpr uint32_t kBitFields = 3, kAlphaBitFields = 6, kHeaderWithAlphaMask = 56;
  const uint32_t header_bytes = word32(header, 14), compression = word32(header, 30);
  const bool has_mask =
      compression == kAlphaBitFields || (compression == kBitFields && header_bytes >= kHeaderWithAlphaMask);
  return !has_mask || word32(header, 66) == 0;
}

/// Byte 494 of the extension, which a TGA of version 2 has, says what alpha means.
bool tga_calls_alpha_undefined(std::ifstream& file) {
  constexpr int kFooterBytes = 26;
  constexpr std::string_view kSignature = "TRUEVISION-XFILE.";
  Bytes footer{};
  file.clear();
  file.seekg(-kFooterBytes, std::ios::end);
  if (!file.read(reinterpret_cast<char*>(footer.data()), kFooterBytes)) return false;
  if (!std::equal(kSignature.begin(), kSignature.end(), footer.begin() + 8)) return false;
  const uint32_t extension = word32(footer, 0);
  file.seekg(static_cast<std::streamoff>(extension) + 494);
  const int type = extension > 0 ? file.get() : -1;
  return type >= 0 && type <= 2;  // none, to be ignored, to be kept; 3 and 4 are alpha
}

}  // namespace

bool says_alpha_is_unused(const std::filesystem::path& path, std::string_view format) {
  if (format != "bmp" && format != "targa") return false;
  std::ifstream file(path, std::ios::binary);
  Bytes header{};
  file.read(reinterpret_cast<char*>(header.data()), header.size());  // the rest stays 0
  if (format == "bmp") return bmp_lacks_alpha(header);
  const int alpha_bits = header[17] & 15;
  return alpha_bits == 0 || tga_calls_alpha_undefined(file);
}

}  // namespace hybridrt
