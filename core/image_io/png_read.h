#pragma once

#include <filesystem>
#include <string>

#include "core/image/image.h"
#include "core/image/texel_image.h"

namespace hybridrt {

/// As read_image(), texel_size(), read_texels() and read_description() of read_image.h, for files that is_png()
/// (png_check.h) accepts: by libpng, to which OpenImageIO would hand them too, but which loads at once. Palettes become
/// colours, fewer than eight bits become eight, transparent colours become alpha; gamma, chromaticities and profiles
/// are left aside. A file whose checksums are wrong, or that is cut short, is refused. Thread-safe.
Image read_png(const std::filesystem::path& path);
TexelSize png_texel_size(const std::filesystem::path& path, int largest_side_px, uint64_t most_texels);
TexelImage read_png_texels(const std::filesystem::path& path, int largest_side_px, uint64_t most_texels);
std::string read_png_description(const std::filesystem::path& path);

}  // namespace hybridrt
