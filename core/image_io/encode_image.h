#pragma once

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "core/image/image.h"
#include "core/image/image_metadata.h"
#include "core/image_io/encode_options.h"

namespace hybridrt {

/// Whether colour pictures can be written under this extension ("png", ".png") or file name ("out/a.png").
bool can_write_format(const std::string& format_or_name);

/// Throws Error (usage), naming the file and common formats, if the extension of `name` cannot be written.
void require_writable_format(const std::filesystem::path& name);

/// Throws Error(usage) if the format cannot hold a picture of that size: JPEG 2000 as OpenImageIO writes it has six
/// resolutions, and for a side under 32 pixels no more than headers come out.
void require_writable_size(const std::filesystem::path& name, int width_px, int height_px);

/// Whether files of that format keep an image's layers.
bool keeps_layers(const std::string& format_or_name);

/// Throws Error (output), naming `name` and the first bad pixel, if there are no pixels or not all are finite.
void require_writable_picture(const Image& linear, const std::string& name);

/// Whether read_description() finds the metadata in files of that format.
bool keeps_metadata(const std::string& format_or_name);

/// Whether files of that format keep an alpha channel beside colours.
bool keeps_alpha(const std::string& format_or_name);

/// The bytes of the whole file; nothing is written to disk. `format_or_name` as in `can_write_format`.
///
/// EXR (ZIP; 32-bit float, or half by the options) and HDR hold the linear values. EXR also holds the image's layers,
/// whole numbers as 32-bit unsigned integers, and its camera as worldToCamera and worldToNDC; the other formats leave
/// them out. All other formats hold 8 bits: clamped to 0-1, through the sRGB curve (alpha linear), rounded to nearest.
/// Grey becomes colour and alpha is left out where the format requires it. EXR holds colours times alpha, as its
/// readers expect; the others hold them as they are. `metadata` becomes the image description, one "name=value" line
/// each, where the format has one. Nothing else is added, so equal arguments give equal bytes.
///
/// Thread-safe; starts no thread. Throws Error (output) when a value is NaN or infinite (naming the pixel) or the
/// writer fails (too large for the format), Error (usage) for a format that cannot be written.
std::vector<unsigned char> encode_image(const Image& linear, const std::string& format_or_name,
                                        const ImageMetadata& metadata = {}, const EncodeOptions& options = {});

/// The libraries that read and write pictures, and their versions that the program was built with.
std::vector<std::pair<std::string, std::string>> image_library_versions();

}  // namespace hybridrt
