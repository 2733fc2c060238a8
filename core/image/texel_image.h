#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <vector>

namespace hybridrt {

/// A picture as textures store it: 8-bit display codes (sRGB), red in a word's lowest byte, then green, blue, alpha
/// (not premultiplied; 255 where the file has none). Row 0 on top.
struct TexelImage {
  int width_px = 0, height_px = 0;
  bool has_alpha = false;
  std::vector<uint32_t> texels;
};

/// Reads a picture file of at most `largest_side_px` and `most_texels`. Thread-safe. Throws Error (input).
using TexelReader =
    std::function<TexelImage(const std::filesystem::path& path, int largest_side_px, uint64_t most_texels)>;

}  // namespace hybridrt
