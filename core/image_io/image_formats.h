#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/base/error.h"
#include "core/image/image.h"
#include "core/image/image_metadata.h"
#include "core/image/texel_image.h"

namespace hybridrt {

/// A format that can be written: OpenImageIO's name of it, and whether files keep an alpha channel beside colours.
struct WrittenFormat {
  std::string name;
  bool alpha;
};

/// All formats but PNG, and EXR where it is written. They are read and written by OpenImageIO, which loads some 260
/// libraries (0.15 s). So this is a shared object of its own (core/image_formats), opened when the first such file is
/// met. The functions are what the headers of their names say.
struct ImageFormats {
  std::optional<WrittenFormat> (*writer_for)(const std::string& extension);
  std::vector<unsigned char> (*encode_format)(const Image& linear, const std::string& format_or_name,
                                              const ImageMetadata& metadata);
  Image (*read_format)(const std::filesystem::path& path);
  TexelSize (*read_format_texel_size)(const std::filesystem::path& path, int largest_side_px, uint64_t most_texels);
  TexelImage (*read_format_texels)(const std::filesystem::path& path, int largest_side_px, uint64_t most_texels);
  std::string (*read_format_description)(const std::filesystem::path& path);
};

/// The one symbol of the shared object: a `const ImageFormats* (*)()`. A change of the table changes the name, so that
/// a program and a shared object that do not belong together find out.
inline constexpr const char* kImageFormatsSymbol = "hybridrt_image_formats_3";

/// Opens the shared object at its first call; it stays open. It lies in the folder of libraries beside the program's
/// own folder, wherever both were moved together. Thread-safe. Throws Error(`kind`), saying where it was looked for,
/// if it cannot be opened.
const ImageFormats& image_formats(ErrorKind kind);

}  // namespace hybridrt
