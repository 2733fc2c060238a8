#pragma once

#include <filesystem>

#include "core/image/image.h"
#include "core/image/image_metadata.h"
#include "core/image/texel_image.h"

namespace hybridrt {

/// Limits kept before anything is allocated; larger files are refused.
inline constexpr int kMaxImageSidePx = 65500;
inline constexpr double kMaxImagePixels = 1 << 30;

/// The first picture of the file, all of its channels (not premultiplied), values as it stores them: integers
/// divided by their maximum and otherwise untouched (display values in PNG and its like), floats as they are.
/// Thread-safe. Throws Error input naming the file: missing, no regular file, no image that OpenImageIO
/// reads, cut short, over the limits above, or too large for the memory.
Image read_image(const std::filesystem::path& path);

/// The same in linear light: integer formats go through the sRGB curve (alpha does not).
Image read_image_linear(const std::filesystem::path& path);

/// The same as 8-bit display codes, for textures; fits TexelReader. Files of floats are clamped to 0-1 and encoded as
/// sRGB; grey becomes three equal colours, channels beyond four are left out. What
/// a BMP or TGA file itself calls no alpha counts as opaque (unused_alpha.h). Takes four bytes a pixel. Over the given
/// limits is too large as well.
TexelImage read_texels(const std::filesystem::path& path, int largest_side_px, uint64_t most_texels);

/// What `encode_image` was handed, without reading the pixels; empty for a file that says nothing or whose
/// format cannot (BMP, HDR, PNM and others). Throws as `read_image`.
ImageMetadata read_image_metadata(const std::filesystem::path& path);

}  // namespace hybridrt
