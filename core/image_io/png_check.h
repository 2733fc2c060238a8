#pragma once

#include <filesystem>
#include <string>

namespace hybridrt {

/// What is wrong with a PNG's chunks (cut short, a wrong checksum), or "" for an intact one and for other formats.
/// libpng would report such files on standard error, which nobody can prevent.
std::string png_fault(const std::filesystem::path& path);

}  // namespace hybridrt
