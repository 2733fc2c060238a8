#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "core/image/image.h"
#include "core/image_io/encode_options.h"

namespace hybridrt {

enum class ExrType { whole, half, single };

/// One channel of a picture in memory: `stride` values apart from pixel to pixel.
struct ExrChannel {
  std::string name;
  ExrType type;
  const uint32_t* first;  ///< bits of a float, or a whole number
  size_t stride;

  size_t value_bytes() const { return type == ExrType::half ? 2 : 4; }
};

/// The channels of the image and of its layers, in the order in which EXR holds them: by name. They point into `image`.
std::vector<ExrChannel> exr_channels(const Image& image, ExrNumbers numbers);

/// Appends `count` values from pixel `begin` on, little-endian as EXR holds them, to `to`, and returns its new end.
uint8_t* write_values(const ExrChannel& channel, size_t begin, size_t count, uint8_t* to);

}  // namespace hybridrt
