#pragma once

#include <cstdint>
#include <filesystem>

namespace hybridrt {

/// Limits that are checked before anything is allocated; larger files are refused.
inline constexpr int kMaxImageSidePx = 65500;
inline constexpr double kMaxImagePixels = 1 << 30;

/// Throws Error (input), naming the file, for a picture over these limits or without pixels.
void require_readable_size(const std::filesystem::path& path, int64_t width_px, int64_t height_px, int channels);

/// What a texture may be.
struct TexelLimits {
  int largest_side_px;
  uint64_t most_texels;
};
/// Throws Error (input), naming the file, for a picture over the given limits.
void require_texel_size(const std::filesystem::path& path, int width_px, int height_px, const TexelLimits& limits);

}  // namespace hybridrt
