#include "core/image_io/exr_channels.h"

#include <Imath/half.h>
#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <fmt/format.h>

#include "core/base/check.h"

namespace hybridrt {
namespace {

static_assert(std::endian::native == std::endian::little);

std::string color_name(int channel, int channels) {
  if (channels <= 2) return channel == 0 ? "Y" : "A";
  constexpr const char* kNames[] = {"R", "G", "B", "A"};
  return channel < 4 ? kNames[channel] : fmt::format("channel{}", channel);
}

bool fits_half(const Image& image) {
  constexpr float kLargestHalf = 65504;
  return std::all_of(image.data.begin(), image.data.end(), [](float v) { return std::abs(v) <= kLargestHalf; });
}

const uint32_t* bits_of(const float* values) { return reinterpret_cast<const uint32_t*>(values); }

}  // namespace

std::vector<ExrChannel> exr_channels(const Image& image, ExrNumbers numbers) {
  const ExrType type = numbers == ExrNumbers::half && fits_half(image) ? ExrType::half : ExrType::single;
  std::vector<ExrChannel> channels;
  const auto stride = static_cast<size_t>(image.channels);
  for (int c = 0; c < image.channels; ++c)
    channels.push_back({color_name(c, image.channels), type, bits_of(image.data.data() + c), stride});
  for (const ImageLayer& layer : image.layers) {
    HRT_CHECK_EQ(layer.values.size() + layer.numbers.size(), image.pixel_count() * layer.channels.size());
    for (size_t c = 0; c < layer.channels.size(); ++c)
      channels.push_back({layer.channels[c], layer.numbers.empty() ? ExrType::single : ExrType::whole,
                          layer.numbers.empty() ? bits_of(layer.values.data() + c) : layer.numbers.data() + c,
                          layer.channels.size()});
  }
  std::sort(channels.begin(), channels.end(), [](const ExrChannel& a, const ExrChannel& b) { return a.name < b.name; });
  return channels;
}

uint8_t* write_values(const ExrChannel& channel, size_t begin, size_t count, uint8_t* to) {
  const uint32_t* from = channel.first + begin * channel.stride;
  for (size_t i = 0; i < count; ++i, from += channel.stride, to += channel.value_bytes()) {
    uint32_t bits;
    std::memcpy(&bits, from, sizeof bits);  // of a float, perhaps
    if (channel.type == ExrType::half) {
      const uint16_t half = imath_float_to_half(std::bit_cast<float>(bits));
      std::memcpy(to, &half, sizeof half);
    } else {
      std::memcpy(to, &bits, sizeof bits);
    }
  }
  return to;
}

}  // namespace hybridrt
