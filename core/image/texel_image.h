#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace hybridrt {

/// A picture as textures store it: 8-bit display codes (sRGB), red in a word's lowest byte, then green, blue, alpha
/// (not premultiplied; 255 where the file has none). Row 0 on top.
struct TexelImage {
  int width_px = 0, height_px = 0;
  bool has_alpha = false;
  std::vector<uint32_t> texels;
  std::string damage = {};  ///< what the decoder says is wrong with pixels that it made up; empty: nothing
};

/// What a file's header says.
struct TexelSize {
  int width_px = 0, height_px = 0;
  uint64_t decoding_bytes = 0;  ///< memory that reading it takes at most, the texels included
};

/// Looks at the header of a picture file, or reads it whole: at most `largest_side_px` and `most_texels`. Thread-safe.
/// Throws Error (input).
using TexelSizer =
    std::function<TexelSize(const std::filesystem::path& path, int largest_side_px, uint64_t most_texels)>;
using TexelReader =
    std::function<TexelImage(const std::filesystem::path& path, int largest_side_px, uint64_t most_texels)>;

/// How textures are read.
struct TexelFiles {
  TexelSizer size;
  TexelReader read;
  explicit operator bool() const { return size && read; }
};

}  // namespace hybridrt
