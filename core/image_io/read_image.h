#pragma once

#include <filesystem>

#include "core/image/image.h"
#include "core/image/texel_image.h"

namespace hybridrt {

/// The first picture of the file, all of its channels (not premultiplied), values as it stores them: integers divided
/// by their maximum and otherwise untouched (display values in PNG and similar formats), floats as they are.
/// Thread-safe. Throws Error (input), naming the file, if it is missing, not a regular file, not an image in
/// a format that we read, cut short, over the limits of image_limits.h, or too large for memory.
Image read_image(const std::filesystem::path& path);

/// The description that encode_image() made of its metadata; empty if there is none, or the file is no image that can
/// be read. Looks at the header, and at a PNG's checksums. Thread-safe.
std::string read_description(const std::filesystem::path& path);

/// What read_texels() will give and take, from the header alone; a TexelSizer. Also throws over the given limits.
TexelSize texel_size(const std::filesystem::path& path, int largest_side_px, uint64_t most_texels);

/// The picture as 8-bit display codes, for textures; a TexelReader. Float files are clamped to 0-1 and encoded as sRGB;
/// grey becomes three equal colours; channels beyond four are left out. Alpha that a BMP or TGA file itself calls
/// unused counts as opaque (unused_alpha.h). Also throws over the given limits.
TexelImage read_texels(const std::filesystem::path& path, int largest_side_px, uint64_t most_texels);

}  // namespace hybridrt
