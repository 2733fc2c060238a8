#pragma once

#include <cstddef>
#include <vector>

namespace hybridrt {

/// Linear light unless said otherwise; row 0 on top, pixels left to right, channels interleaved.
struct Image {
  int width_px = 0, height_px = 0, channels = 0;
  std::vector<float> data;  ///< width_px * height_px * channels

  Image() = default;
  Image(int width, int height, int channel_count, float fill = 0)
      : width_px(width),
        height_px(height),
        channels(channel_count),
        data(static_cast<size_t>(width) * height * channel_count, fill) {}

  size_t pixel_count() const { return static_cast<size_t>(width_px) * height_px; }
  float* pixel(int x, int y) { return &data[(static_cast<size_t>(y) * width_px + x) * channels]; }
  const float* pixel(int x, int y) const { return &data[(static_cast<size_t>(y) * width_px + x) * channels]; }
};

}  // namespace hybridrt
