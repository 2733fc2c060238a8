#include "core/image_io/written_channels.h"

#include <filesystem>

#include "core/image/srgb.h"

namespace hybridrt {

std::string extension_of(const std::string& format_or_name) {
  std::string extension = std::filesystem::path(format_or_name).extension().string();
  if (extension.empty() && format_or_name.find('/') == std::string::npos) extension = format_or_name;
  if (extension.starts_with('.')) extension.erase(0, 1);
  return extension;
}

Image with_channels(const Image& image, int colors, bool alpha) {
  Image result(image.width_px, image.height_px, colors + alpha);
  const int from_alpha = alpha_channel(image.channels);
  for (size_t pixel = 0; pixel < image.pixel_count(); ++pixel) {
    const float* const from = &image.data[pixel * image.channels];
    float* const to = &result.data[pixel * result.channels];
    for (int c = 0; c < colors; ++c) to[c] = from[image.channels >= 3 ? c : 0];
    if (alpha) to[colors] = from[from_alpha];
  }
  return result;
}

}  // namespace hybridrt
