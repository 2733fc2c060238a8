#include "core/image_formats/encode_format.h"

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>
#include <memory>
#include <optional>
#include <string_view>
#include <utility>

#include "core/base/check.h"
#include "core/base/error.h"
#include "core/image/srgb.h"
#include "core/image_formats/memory_file.h"
#include "core/image_formats/oiio_setup.h"
#include "core/image_io/written_channels.h"

namespace hybridrt {
namespace {

using Output = std::unique_ptr<OIIO::ImageOutput>;

/// A writer for the format, or null.
Output create_writer(const std::string& format_or_name) {
  set_up_oiio();
  const std::string extension = extension_of(format_or_name);
  if (extension.empty()) return nullptr;
  Output writer = OIIO::ImageOutput::create(extension);
  if (!writer) {
    OIIO::geterror();  // cleared, or OpenImageIO prints it at exit
    return nullptr;
  }
  return is_picture_format(writer->format_name()) ? std::move(writer) : nullptr;
}

/// The image with the channels that the format can hold.
Image with_writable_channels(const Image& image, const OIIO::ImageOutput& writer) {
  const std::string_view format = writer.format_name();
  const bool grey_fits = format == "jpeg" || format == "tiff";
  const bool has_alpha = alpha_channel(image.channels) >= 0;
  const bool keep_alpha = has_alpha && writer.supports("alpha") && (image.channels == 4 || grey_fits);
  const int colors = image.channels >= 3 || !grey_fits ? 3 : 1;
  return colors + keep_alpha == image.channels ? image : with_channels(image, colors, keep_alpha);
}

OIIO::ImageSpec make_spec(const Image& image, std::string_view format, bool is_float, const ImageMetadata& metadata) {
  OIIO::ImageSpec spec(image.width_px, image.height_px, image.channels, is_float ? OIIO::TypeFloat : OIIO::TypeUInt8);
  if (!metadata.empty()) spec.attribute("ImageDescription", description_of(metadata));
  spec.attribute("oiio:UnassociatedAlpha", 1);  // leave the colours alone
  // A DateTime that is not a string: the writers see that there is one, do not add the current time, and then write
  // none.
  spec.attribute("DateTime", 0);
  // Not for TIFF: OpenImageIO 2.4 then adds an Exif directory, and a file written in memory is corrupt.
  if (format == "jpeg") spec.attribute("oiio:ColorSpace", "sRGB");
  if (format == "tiff") spec.attribute("compression", "lzw");
  if (format == "jpeg") spec.attribute("CompressionQuality", 95);
  return spec;
}

}  // namespace

std::optional<WrittenFormat> writer_for(const std::string& extension) {
  const Output writer = create_writer(extension);
  if (!writer) return std::nullopt;
  return WrittenFormat{writer->format_name(), writer->supports("alpha") != 0};
}

std::vector<unsigned char> encode_format(const Image& linear, const std::string& format_or_name,
                                         const ImageMetadata& metadata) {
  // Before the writer: it holds on to the proxy and the file until it is destroyed.
  std::vector<unsigned char> bytes;
  OIIO::Filesystem::IOVecOutput proxy(bytes);
  std::optional<MemoryFile> file;

  const Output writer = create_writer(format_or_name);
  HRT_CHECK(writer);
  const std::string format = writer->format_name();
  const Image image = with_writable_channels(linear, *writer);
  const bool is_float = format == "hdr";
  const OIIO::ImageSpec spec = make_spec(image, format, is_float, metadata);
  writer->threads(1);
  std::string file_name = "memory." + extension_of(format_or_name);  // JPEG 2000 and PNM have variants by extension
  if (writer->supports("ioproxy"))
    writer->set_ioproxy(&proxy);
  else
    file_name = file.emplace().path();

  const std::vector<uint8_t> codes = is_float ? std::vector<uint8_t>() : srgb8_from_linear(image);
  const bool written =
      writer->open(file_name, spec) && (is_float ? writer->write_image(OIIO::TypeFloat, image.data.data())
                                                 : writer->write_image(OIIO::TypeUInt8, codes.data()));
  if (!writer->close() || !written)
    throw error(ErrorKind::output, "{}: cannot be encoded: {}; choose another format or size", format_or_name,
                one_line(writer->geterror()));
  if (file) bytes = file->contents();
  if (bytes.empty())
    throw error(ErrorKind::output, "{}: the encoder gave no bytes; choose another format", format_or_name);
  return bytes;
}

}  // namespace hybridrt
