#include "core/image_io/png_read.h"

#include <algorithm>
#include <cstring>
#include <limits>

#include "core/base/error.h"
#include "core/image/srgb.h"
#include "core/image_io/image_limits.h"
#include "core/image_io/png_check.h"
#include "core/image_io/png_file.h"
#include "core/image_io/texel_of.h"

namespace hybridrt {
namespace {

void require_whole(const std::filesystem::path& path) {
  if (const std::string fault = png_fault(path); !fault.empty())
    throw error(ErrorKind::input, "{}: broken image: {}; write or copy it again", path.string(), fault);
}

uint16_t word_at(const uint8_t* bytes) {
  uint16_t word = 0;
  std::memcpy(&word, bytes, sizeof word);
  return word;
}

}  // namespace

Image read_png(const std::filesystem::path& path) {
  require_whole(path);
  PngFile file(path);
  require_readable_size(path, file.width_px(), file.height_px(), file.channels());
  Image image;
  image.width_px = file.width_px(), image.height_px = file.height_px(), image.channels = file.channels();
  const size_t row_values = static_cast<size_t>(image.width_px) * image.channels;
  image.data.reserve(row_values * image.height_px);
  file.read_rows([&](const uint8_t* bytes, int count) {
    const size_t first = image.data.size(), values = row_values * count;
    image.data.resize(first + values);
    float* const to = image.data.data() + first;
    if (file.channel_bytes() == 1)
      for (size_t i = 0; i < values; ++i) to[i] = static_cast<float>(bytes[i]) * (1.0f / 255);
    else
      for (size_t i = 0; i < values; ++i) to[i] = static_cast<float>(word_at(bytes + 2 * i)) * (1.0f / 65535);
  });
  return image;
}

TexelSize png_texel_size(const std::filesystem::path& path, int largest_side_px, uint64_t most_texels) {
  constexpr uint64_t kBytesPerTexel = 4;
  const PngFile file = [&] {
    try {
      return PngFile(path);
    } catch (const Error&) {
      require_whole(path);  // knows the reason better
      throw;
    }
  }();
  require_readable_size(path, file.width_px(), file.height_px(), file.channels());
  require_texel_size(path, file.width_px(), file.height_px(), {largest_side_px, most_texels});
  const auto height = static_cast<uint64_t>(file.height_px());
  return {file.width_px(), file.height_px(),
          height * (kBytesPerTexel * static_cast<uint64_t>(file.width_px()) + 2 * file.row_bytes())};
}

TexelImage read_png_texels(const std::filesystem::path& path, int largest_side_px, uint64_t most_texels) {
  require_whole(path);
  PngFile file(path);
  require_readable_size(path, file.width_px(), file.height_px(), file.channels());
  require_texel_size(path, file.width_px(), file.height_px(), {largest_side_px, most_texels});
  TexelImage image;
  image.width_px = file.width_px(), image.height_px = file.height_px();
  image.has_alpha = alpha_channel(file.channels()) >= 0;
  image.texels.reserve(static_cast<size_t>(image.width_px) * image.height_px);
  const int channels = file.channels();
  std::vector<uint8_t> narrowed;
  file.read_rows([&](const uint8_t* bytes, int count) {
    const size_t values = static_cast<size_t>(image.width_px) * channels * count;
    if (file.channel_bytes() == 2) {
      narrowed.resize(values);
      for (size_t i = 0; i < values; ++i)  // by rounding
        narrowed[i] = static_cast<uint8_t>((word_at(bytes + 2 * i) * 255u + 32767) / 65535);
      bytes = narrowed.data();
    }
    for (size_t i = 0; i < values; i += channels) image.texels.push_back(texel_of(bytes + i, channels));
  });
  return image;
}

std::string read_png_description(const std::filesystem::path& path) {
  require_whole(path);
  const PngFile file(path);
  require_readable_size(path, file.width_px(), file.height_px(), file.channels());
  return file.description();
}

}  // namespace hybridrt
