#include "core/image_io/png_write.h"

#include <algorithm>
#include <libdeflate.h>
#include <limits>
#include <span>
#include <string_view>
#include <utility>

#include "core/base/check.h"
#include "core/image/srgb.h"
#include "core/image_io/deflate.h"
#include "core/image_io/png_filter.h"

namespace hybridrt {
namespace {

using Bytes = std::vector<uint8_t>;

constexpr PngFilter kNone[] = {PngFilter::none};
constexpr PngFilter kSubUp[] = {PngFilter::sub, PngFilter::up};
constexpr PngFilter kAll[] = {PngFilter::none, PngFilter::sub, PngFilter::up, PngFilter::average, PngFilter::paeth};

void add_number(Bytes& bytes, uint32_t number) {
  for (int shift = 24; shift >= 0; shift -= 8) bytes.push_back(static_cast<uint8_t>(number >> shift));
}

void add_chunk(Bytes& bytes, std::string_view type, std::span<const uint8_t> contents) {
  add_number(bytes, static_cast<uint32_t>(contents.size()));
  const size_t begin = bytes.size();
  bytes.insert(bytes.end(), type.begin(), type.end());
  bytes.insert(bytes.end(), contents.begin(), contents.end());
  add_number(bytes, libdeflate_crc32(0, bytes.data() + begin, bytes.size() - begin));
}

Bytes header(const Image& image) {
  static constexpr uint8_t kColorTypes[] = {0, 4, 2, 6};  // grey, grey and alpha, colours, colours and alpha
  Bytes bytes;
  add_number(bytes, static_cast<uint32_t>(image.width_px));
  add_number(bytes, static_cast<uint32_t>(image.height_px));
  for (const uint8_t byte : {uint8_t{8}, kColorTypes[image.channels - 1], uint8_t{0}, uint8_t{0}, uint8_t{0}})
    bytes.push_back(byte);
  return bytes;
}

/// sRGB, and what it means for readers that do not know it (section 11.3.2.5).
void add_color_space(Bytes& bytes) {
  constexpr uint8_t kPerceptual = 0;
  add_chunk(bytes, "sRGB", {&kPerceptual, 1});
  Bytes gamma, chromaticities;
  add_number(gamma, 45455);
  for (const uint32_t x : {31270, 32900, 64000, 33000, 30000, 60000, 15000, 6000}) add_number(chromaticities, x);
  add_chunk(bytes, "gAMA", gamma);
  add_chunk(bytes, "cHRM", chromaticities);
}

void add_text(Bytes& bytes, const std::string& description) {
  if (description.empty()) return;
  Bytes text;
  for (const std::string_view part : {std::string_view("Description\0", 12), std::string_view(description)})
    text.insert(text.end(), part.begin(), part.end());
  add_chunk(bytes, "tEXt", text);
}

/// Hands bands of filtered rows to `take(bytes, last)`. A band and what it is made of stay in a processor's cache.
template <typename Take>
void filter_bands(const Image& linear, std::span<const PngFilter> filters, Take take) {
  constexpr size_t kBandBytes = size_t{1} << 16;
  const size_t row_bytes = static_cast<size_t>(linear.width_px) * linear.channels;
  const int band_rows = static_cast<int>(std::max<size_t>(1, kBandBytes / (1 + row_bytes)));
  Bytes above(row_bytes), codes(row_bytes), scratch, band;
  for (int y = 0; y < linear.height_px; y += band_rows) {
    const int rows = std::min(band_rows, linear.height_px - y);
    band.resize((1 + row_bytes) * rows);
    for (int i = 0; i < rows; ++i) {
      srgb8_from_linear({linear.pixel(0, y + i), row_bytes}, linear.channels, codes.data());
      const PngRow row{codes.data(), above.data(), row_bytes, static_cast<size_t>(linear.channels)};
      filter_row_by_sum(row, filters, scratch, band.data() + (1 + row_bytes) * i);
      std::swap(codes, above);
    }
    take(std::span<const uint8_t>(band), y + rows == linear.height_px);
  }
}

PackedBytes packed_fast(const Image& linear, std::span<const PngFilter> filters) {
  FastDeflate deflate;
  filter_bands(linear, filters, [&](std::span<const uint8_t> band, bool last) { deflate.add(band, last); });
  return std::move(deflate.packed());
}

PackedBytes packed_small(const Image& linear) {
  std::span<const PngFilter> best;
  size_t least = std::numeric_limits<size_t>::max();
  for (const std::span<const PngFilter> filters : {std::span<const PngFilter>(kNone), {kSubUp}, {kAll}}) {
    const size_t size = packed_fast(linear, filters).size();
    if (size < least) best = filters, least = size;
  }
  Bytes rows;
  rows.reserve((1 + static_cast<size_t>(linear.width_px) * linear.channels) * linear.height_px);
  filter_bands(linear, best,
               [&](std::span<const uint8_t> band, bool) { rows.insert(rows.end(), band.begin(), band.end()); });
  return deflate_small(rows);
}

}  // namespace

std::vector<unsigned char> encode_png(const Image& linear, const std::string& description, Compression compression) {
  constexpr std::string_view kSignature = "\x89PNG\r\n\x1a\n";
  constexpr size_t kMostInChunk = size_t{1} << 30;
  HRT_CHECK(linear.pixel_count() > 0 && linear.channels >= 1 && linear.channels <= 4);
  const PackedBytes packed = compression == Compression::small ? packed_small(linear) : packed_fast(linear, kSubUp);
  Bytes bytes(kSignature.begin(), kSignature.end());
  bytes.reserve(packed.size() + description.size() + 256);
  add_chunk(bytes, "IHDR", header(linear));
  add_color_space(bytes);
  add_text(bytes, description);
  for (size_t begin = 0; begin < packed.size(); begin += kMostInChunk)
    add_chunk(bytes, "IDAT", std::span(packed).subspan(begin, std::min(kMostInChunk, packed.size() - begin)));
  add_chunk(bytes, "IEND", {});
  return bytes;
}

}  // namespace hybridrt
