#include "core/image_io/encode_image.h"

#include <algorithm>
#include <isa-l.h>
#include <libdeflate.h>
#include <optional>
#include <png.h>

#include "core/base/error.h"
#include "core/image/compare.h"
#include "core/image_io/exr_write.h"
#include "core/image_io/image_formats.h"
#include "core/image_io/png_write.h"
#include "core/image_io/written_channels.h"

namespace hybridrt {
namespace {

std::string lower_case(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(),
                 [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; });
  return text;
}

/// Opens the other formats only for a name that is not a PNG's or EXR's.
std::optional<WrittenFormat> format_of(const std::string& format_or_name) {
  const std::string extension = lower_case(extension_of(format_or_name));
  if (extension.empty()) return std::nullopt;
  if (extension == "png") return WrittenFormat{"png", true};
  if (extension == "exr") return WrittenFormat{"openexr", true};
  return image_formats(ErrorKind::output).writer_for(extension);
}

WrittenFormat require_format(const std::string& format_or_name) {
  if (const std::optional<WrittenFormat> format = format_of(format_or_name)) return *format;
  throw error(ErrorKind::usage, "{}: no picture format that can be written; use .png, .exr, .jpg, .tif, .hdr or .bmp",
              format_or_name);
}

void require_size(const WrittenFormat& format, const std::string& name, int width_px, int height_px) {
  constexpr int kLeastJpeg2000_px = 32;
  if (format.name == "jpeg2000" && std::min(width_px, height_px) < kLeastJpeg2000_px)
    throw error(ErrorKind::usage, "{}: {}x{} pixels are too small for JPEG 2000, which takes {} a side; use .png", name,
                width_px, height_px, kLeastJpeg2000_px);
}

}  // namespace

bool can_write_format(const std::string& format_or_name) { return format_of(format_or_name).has_value(); }

bool keeps_layers(const std::string& format_or_name) {
  const auto format = format_of(format_or_name);
  return format && format->name == "openexr";
}

bool keeps_alpha(const std::string& format_or_name) {
  const auto format = format_of(format_or_name);
  return format && format->alpha;
}

bool keeps_metadata(const std::string& format_or_name) {
  const auto format = format_of(format_or_name);
  return format &&
         (format->name == "png" || format->name == "openexr" || format->name == "jpeg" || format->name == "tiff");
}

void require_writable_format(const std::filesystem::path& name) { require_format(name.string()); }

void require_writable_size(const std::filesystem::path& name, int width_px, int height_px) {
  require_size(require_format(name.string()), name.string(), width_px, height_px);
}

void require_writable_picture(const Image& linear, const std::string& name) {
  if (linear.pixel_count() == 0) throw error(ErrorKind::output, "{}: the picture has no pixels", name);
  if (const NonFinite at = find_non_finite(linear); at.found)
    throw error(ErrorKind::output,
                "{}: not written: pixel ({}, {}), channel {} is not a finite number; look for "
                "extreme numbers in the scene's materials and lights",
                name, at.x, at.y, at.channel);
}

std::vector<unsigned char> encode_image(const Image& linear, const std::string& format_or_name,
                                        const ImageMetadata& metadata, const EncodeOptions& options) {
  const WrittenFormat format = require_format(format_or_name);
  require_size(format, format_or_name, linear.width_px, linear.height_px);
  require_writable_picture(linear, format_or_name);
  const std::string description = description_of(metadata);
  if (format.name == "openexr") return encode_exr(linear, format_or_name, description, options);
  if (format.name != "png") return image_formats(ErrorKind::output).encode_format(linear, format_or_name, metadata);
  return linear.channels <= 4 ? encode_png(linear, description, options.compression)
                              : encode_png(with_channels(linear, 3, false), description, options.compression);
}

std::vector<std::pair<std::string, std::string>> image_library_versions() {
  return {{"openimageio", HYBRIDRT_OPENIMAGEIO_VERSION},
          {"openexr", HYBRIDRT_OPENEXR_VERSION},
          {"libpng", PNG_LIBPNG_VER_STRING},
          {"isa-l", fmt::format("{}.{}.{}", ISAL_MAJOR_VERSION, ISAL_MINOR_VERSION, ISAL_PATCH_VERSION)},
          {"libdeflate", LIBDEFLATE_VERSION_STRING}};
}

}  // namespace hybridrt
