// PNG: as a picture and as a texture. Chunks get the checksums that they should have, or no input would come far.

#include <stdexcept>
#include <zlib.h>

#include "core/base/error.h"
#include "core/image_io/png_check.h"
#include "core/image_io/png_read.h"
#include "tests/fuzz/input_file.h"
#include "tests/fuzz/reader.h"

namespace hybridrt::fuzz {
namespace {

constexpr size_t kSignatureBytes = 8, kChunkBytes = 12;  // a chunk's length, type and checksum

uint32_t number_at(const std::string& bytes, size_t place) {
  uint32_t number = 0;
  for (size_t i = 0; i < 4; ++i) number = number << 8 | static_cast<uint8_t>(bytes[place + i]);
  return number;
}

std::string with_checksums(std::string bytes) {
  size_t chunk = kSignatureBytes;
  while (chunk + kChunkBytes <= bytes.size()) {
    const uint32_t length = number_at(bytes, chunk);
    if (length > bytes.size() - chunk - kChunkBytes) break;
    const uLong sum = crc32(0, reinterpret_cast<const Bytef*>(&bytes[chunk + 4]), length + 4);
    for (size_t i = 0; i < 4; ++i) bytes[chunk + 8 + length + i] = static_cast<char>(sum >> (24 - 8 * i));
    chunk += kChunkBytes + length;
  }
  return bytes;
}

}  // namespace

void read_input(std::string_view bytes) {
  constexpr int kLargestSide_px = 4096;
  constexpr uint64_t kMostTexels = 1 << 20;
  const std::filesystem::path png = input_file("input.png", with_checksums(std::string(bytes)));
  if (!is_png(png)) throw error(ErrorKind::input, "no PNG");
  const TexelSize size = png_texel_size(png, kLargestSide_px, kMostTexels);
  const TexelImage texels = read_png_texels(png, kLargestSide_px, kMostTexels);
  const Image image = read_png(png);
  read_png_description(png);
  if (texels.width_px != size.width_px || texels.height_px != size.height_px || image.width_px != size.width_px ||
      image.height_px != size.height_px)
    throw std::logic_error("its size is another when it is read");
  if (texels.texels.size() != image.pixel_count()) throw std::logic_error("not as many texels as pixels");
}

}  // namespace hybridrt::fuzz
