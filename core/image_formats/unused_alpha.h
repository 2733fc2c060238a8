#pragma once

#include <filesystem>
#include <string_view>

namespace hybridrt {

/// Whether a BMP or TGA file says itself that what looks like its alpha channel is none: a BMP without a mask for alpha
/// (32 bits of BI_RGB: the fourth byte is reserved), a TGA with no bits of alpha, or whose extension calls them
/// undefined. `format` is OpenImageIO's name. False for other formats and files that cannot be read.
bool says_alpha_is_unused(const std::filesystem::path& path, std::string_view format);

}  // namespace hybridrt
