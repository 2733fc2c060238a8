#include "core/image_io/image_limits.h"

#include "core/base/error.h"

namespace hybridrt {

void require_readable_size(const std::filesystem::path& path, int64_t width_px, int64_t height_px, int channels) {
  if (width_px < 1 || height_px < 1 || channels < 1)
    throw error(ErrorKind::input, "{}: holds no pixels; write the image again", path.string());
  if (width_px > kMaxImageSidePx || height_px > kMaxImageSidePx ||
      static_cast<double>(width_px) * static_cast<double>(height_px) > kMaxImagePixels || channels > 1024)
    throw error(ErrorKind::input, "{}: {}x{} pixels with {} channels is too large; at most {} on a side and {} in all",
                path.string(), width_px, height_px, channels, kMaxImageSidePx, kMaxImagePixels);
}

void require_texel_size(const std::filesystem::path& path, int width_px, int height_px, const TexelLimits& limits) {
  if (width_px > limits.largest_side_px || height_px > limits.largest_side_px ||
      static_cast<uint64_t>(width_px) * static_cast<uint64_t>(height_px) > limits.most_texels)
    throw error(ErrorKind::input, "{}: {}x{} pixels are too large for a texture; at most {} on a side and {} in all",
                path.string(), width_px, height_px, limits.largest_side_px, limits.most_texels);
}

}  // namespace hybridrt
