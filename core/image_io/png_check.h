#pragma once

#include <filesystem>
#include <string>

namespace hybridrt {

/// Whether the file begins as PNGs do, whatever it is called. False for what cannot be opened.
bool is_png(const std::filesystem::path& path);

/// What is wrong with the lengths of such a file's chunks, or "": libpng makes room for what a chunk claims.
std::string png_length_fault(const std::filesystem::path& path);

/// What is wrong with the chunks of such a file (cut short, a wrong checksum), or "". libpng takes files whose wrong
/// checksum is not the pixels', and does not miss their end.
std::string png_fault(const std::filesystem::path& path);

}  // namespace hybridrt
