#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "core/image/image.h"
#include "core/image/image_metadata.h"

namespace hybridrt {

/// Whether colour pictures can be written under this extension ("png", ".png") or file name ("out/a.png").
bool can_write_format(const std::string& format_or_name);

/// Throws Error usage naming the file and common formats when `name` has an extension that cannot be written.
void require_writable_format(const std::filesystem::path& name);

/// Whether files of that format keep an image's layers.
bool keeps_layers(const std::string& format_or_name);

/// The whole file in memory, not a byte on disk. `format_or_name` as in `can_write_format`.
///
/// EXR (32-bit float, ZIP) and HDR hold the linear values. An EXR has the image's layers too, as channels
/// LAYER.CHANNEL (LAYER alone where the channel has no name), whole numbers as 32-bit unsigned ones; the other
/// formats leave them out. All other formats hold 8 bits: clamped to 0-1,
/// through the sRGB curve (alpha straight), rounded to the nearest. Grey becomes colour and alpha is left out
/// where the format asks for it. `metadata` goes in as the image description, a "name=value" line each, where
/// the format has one; nothing else does, so equal arguments give equal bytes.
///
/// Thread-safe, on the calling thread only. Throws Error output when a value is NaN or infinite (naming the
/// pixel) or the writer fails (too large for the format), Error usage for a format that cannot be written.
std::vector<unsigned char> encode_image(const Image& linear, const std::string& format_or_name,
                                        const ImageMetadata& metadata = {});

/// The same, the format told by the path's extension: fits FileSink.
inline std::vector<unsigned char> encode_image_file(const Image& linear, const std::filesystem::path& path,
                                                    const ImageMetadata& metadata) {
  return encode_image(linear, path.string(), metadata);
}

/// Of OpenImageIO.
std::string image_library_version();

}  // namespace hybridrt
