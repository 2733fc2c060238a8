#pragma once

#include <filesystem>
#include <string>

namespace hybridrt {

/// What is wrong with a PNG's chunks (cut short, a checksum), or "" for a whole one and for files of other formats.
/// libpng writes of such files to standard error, past everybody who could stop it.
std::string png_fault(const std::filesystem::path& path);

}  // namespace hybridrt
