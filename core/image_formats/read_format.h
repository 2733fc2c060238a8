#pragma once

#include <filesystem>
#include <string>

#include "core/image/image.h"
#include "core/image/texel_image.h"

namespace hybridrt {

/// As read_image(), texel_size(), read_texels() and read_description() of image_io, for regular files that are no PNGs.
Image read_format(const std::filesystem::path& path);
TexelSize read_format_texel_size(const std::filesystem::path& path, int largest_side_px, uint64_t most_texels);
TexelImage read_format_texels(const std::filesystem::path& path, int largest_side_px, uint64_t most_texels);
std::string read_format_description(const std::filesystem::path& path);

}  // namespace hybridrt
