#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "core/base/uninitialized.h"

namespace hybridrt {

/// Further channels of a picture, under names of their own.
struct ImageLayer {
  std::string name;                   ///< id, depth, normal, …
  std::vector<std::string> channels;  ///< names in a file that names its channels: "N.X", "N.Y", "N.Z"
  std::vector<float> values;          ///< one value per pixel and channel, interleaved; or
  std::vector<uint32_t> numbers;      ///< one whole number per pixel and channel
};

/// Where a picture was taken from, as EXR headers say it: matrices for row vectors, row after row.
struct ImageCamera {
  std::array<float, 16> camera_from_world{};  ///< x to the right, y up, looking along -z
  std::array<float, 16> ndc_from_world{};     ///< -1..1 over the frame, y up
};

/// Linear light unless said otherwise; row 0 on top, pixels left to right, channels interleaved. The last of two or
/// four channels is alpha (coverage), which the others are not multiplied by.
struct Image {
  int width_px = 0, height_px = 0, channels = 0;
  UninitializedVector<float> data;    ///< width_px * height_px * channels
  std::vector<ImageLayer> layers;     ///< kept only by formats that name their channels (EXR)
  std::optional<ImageCamera> camera;  ///< likewise

  Image() = default;
  Image(int width, int height, int channel_count, float fill = 0)
      : width_px(width),
        height_px(height),
        channels(channel_count),
        data(static_cast<size_t>(width) * height * channel_count, fill) {}

  /// Its pixels are not set, and their memory not touched.
  static Image uninitialized(int width, int height, int channel_count) {
    Image image;
    image.width_px = width, image.height_px = height, image.channels = channel_count;
    image.data.resize(static_cast<size_t>(width) * height * channel_count);
    return image;
  }

  size_t pixel_count() const { return static_cast<size_t>(width_px) * height_px; }
  float* pixel(int x, int y) { return &data[(static_cast<size_t>(y) * width_px + x) * channels]; }
  const float* pixel(int x, int y) const { return &data[(static_cast<size_t>(y) * width_px + x) * channels]; }
};

/// What the image's pixels hold, those of its layers included.
inline size_t memory_bytes(const Image& image) {
  size_t values = image.data.size();
  for (const ImageLayer& layer : image.layers) values += layer.values.size() + layer.numbers.size();
  return values * sizeof(float);
}

}  // namespace hybridrt
