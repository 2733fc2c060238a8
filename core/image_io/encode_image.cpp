#include "core/image_io/encode_image.h"

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>
#include <algorithm>
#include <bit>
#include <cmath>
#include <memory>
#include <optional>
#include <string_view>
#include <utility>

#include "core/base/check.h"
#include "core/base/error.h"
#include "core/image/compare.h"
#include "core/image/srgb.h"
#include "core/image_io/memory_file.h"
#include "core/image_io/oiio_setup.h"

namespace hybridrt {
namespace {

using Output = std::unique_ptr<OIIO::ImageOutput>;

/// "png" of "out/a.png", ".png" and "png"; empty where there is none.
std::string extension_of(const std::string& format_or_name) {
  std::string extension = std::filesystem::path(format_or_name).extension().string();
  if (extension.empty() && format_or_name.find('/') == std::string::npos) extension = format_or_name;
  if (extension.starts_with('.')) extension.erase(0, 1);
  return extension;
}

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

Output require_writer(const std::string& format_or_name) {
  if (Output writer = create_writer(format_or_name)) return writer;
  throw error(ErrorKind::usage, "{}: no picture format that can be written; use .png, .exr, .jpg, .tif, .hdr or .bmp",
              format_or_name);
}

/// Colours times alpha, as EXR holds them.
Image associated(Image image) {
  const int alpha = alpha_channel(image.channels);
  for (size_t first = 0; alpha >= 0 && first < image.data.size(); first += image.channels)
    for (int c = 0; c < alpha; ++c) image.data[first + c] *= image.data[first + alpha];
  return image;
}

/// The image with the channels that the format can hold.
Image with_writable_channels(const Image& image, const OIIO::ImageOutput& writer) {
  const std::string_view format = writer.format_name();
  if (format == "openexr") return image;
  const bool grey_fits = format == "png" || format == "jpeg" || format == "tiff";
  const bool has_alpha = alpha_channel(image.channels) >= 0;
  const bool keep_alpha = has_alpha && writer.supports("alpha") && (image.channels == 4 || grey_fits);
  const int colors = image.channels >= 3 || !grey_fits ? 3 : 1;
  const int channels = colors + keep_alpha;
  if (channels == image.channels) return image;

  Image result(image.width_px, image.height_px, channels);
  for (size_t pixel = 0; pixel < image.pixel_count(); ++pixel)
    for (int c = 0; c < channels; ++c)
      result.data[pixel * channels + c] = image.data[pixel * image.channels + (image.channels >= 3 ? c : 0)];
  return result;
}

OIIO::ImageSpec make_spec(const Image& image, std::string_view format, bool is_float, const ImageMetadata& metadata) {
  OIIO::ImageSpec spec(image.width_px, image.height_px, image.channels, is_float ? OIIO::TypeFloat : OIIO::TypeUInt8);
  if (!metadata.empty()) spec.attribute("ImageDescription", description_of(metadata));
  if (format != "openexr") spec.attribute("oiio:UnassociatedAlpha", 1);  // leave the colours alone
  // A DateTime that is not a string: the writers see that there is one, do not add the current time, and then write
  // none.
  spec.attribute("DateTime", 0);
  if (format == "png") {
    // 1024x768 pixels take 14 ms and 383 kB. The library's defaults (level 6, the filter chosen by trial per row) take
    // 88 ms and 308 kB; level 1 with filters by trial is slower (27 ms) and larger.
    spec.attribute("png:compressionLevel", 1);
    spec.attribute("png:filter", 0x20);  // PNG_FILTER_UP
  }
  // Not for TIFF: OpenImageIO 2.4 then adds an Exif directory, and a file written in memory is corrupt.
  if (format == "png" || format == "jpeg") spec.attribute("oiio:ColorSpace", "sRGB");
  if (format == "tiff") spec.attribute("compression", "lzw");
  if (format == "openexr") spec.attribute("compression", "zip");
  if (format == "jpeg") spec.attribute("CompressionQuality", 95);
  return spec;
}

/// Adds the layers' channels after the image's own. EXR files name their channels.
void describe_layers(const Image& image, OIIO::ImageSpec& spec) {
  spec.default_channel_names();
  spec.channelformats.assign(static_cast<size_t>(image.channels), OIIO::TypeFloat);
  for (const ImageLayer& layer : image.layers)
    for (const std::string& channel : layer.channels) {
      HRT_CHECK_EQ(layer.values.size() + layer.numbers.size(), image.pixel_count() * layer.channels.size());
      spec.channelnames.push_back(channel);
      spec.channelformats.push_back(layer.numbers.empty() ? OIIO::TypeFloat : OIIO::TypeUInt32);
    }
  spec.nchannels = static_cast<int>(spec.channelnames.size());
}

/// Per pixel the image's channels, then the layers', each in four bytes.
std::vector<uint32_t> interleaved_with_layers(const Image& image) {
  std::vector<uint32_t> words;
  for (size_t pixel = 0; pixel < image.pixel_count(); ++pixel) {
    const auto add = [&](const auto& values, size_t channels) {
      for (size_t c = 0; c < channels; ++c) words.push_back(std::bit_cast<uint32_t>(values[pixel * channels + c]));
    };
    add(image.data, static_cast<size_t>(image.channels));
    for (const ImageLayer& layer : image.layers)
      if (layer.numbers.empty())
        add(layer.values, layer.channels.size());
      else
        add(layer.numbers, layer.channels.size());
  }
  return words;
}

void require_finite_layers(const Image& image, const std::string& name) {
  for (const ImageLayer& layer : image.layers)
    for (float value : layer.values)
      if (!std::isfinite(value))
        throw error(ErrorKind::output, "{}: not written: its layer {} has a value that is not a finite number", name,
                    layer.name);
}

}  // namespace

bool can_write_format(const std::string& format_or_name) { return create_writer(format_or_name) != nullptr; }

bool keeps_layers(const std::string& format_or_name) {
  const Output writer = create_writer(format_or_name);
  return writer && std::string_view(writer->format_name()) == "openexr";
}

bool keeps_alpha(const std::string& format_or_name) {
  const Output writer = create_writer(format_or_name);
  return writer && writer->supports("alpha");
}

bool keeps_metadata(const std::string& format_or_name) {
  const Output writer = create_writer(format_or_name);
  if (!writer) return false;
  const std::string_view format = writer->format_name();
  return format == "png" || format == "openexr" || format == "jpeg" || format == "tiff";
}

void require_writable_format(const std::filesystem::path& name) { require_writer(name.string()); }

void require_writable_size(const std::filesystem::path& name, int width_px, int height_px) {
  constexpr int kLeastJpeg2000_px = 32;
  if (std::string_view(require_writer(name.string())->format_name()) == "jpeg2000" &&
      std::min(width_px, height_px) < kLeastJpeg2000_px)
    throw error(ErrorKind::usage, "{}: {}x{} pixels are too small for JPEG 2000, which takes {} a side; use .png",
                name.string(), width_px, height_px, kLeastJpeg2000_px);
}

std::vector<unsigned char> encode_image(const Image& linear, const std::string& format_or_name,
                                        const ImageMetadata& metadata) {
  // Before the writer: it holds on to the proxy and the file until it is destroyed.
  std::vector<unsigned char> bytes;
  OIIO::Filesystem::IOVecOutput proxy(bytes);
  std::optional<MemoryFile> file;

  const Output writer = require_writer(format_or_name);
  const std::string format = writer->format_name();
  require_writable_size(format_or_name, linear.width_px, linear.height_px);
  if (linear.pixel_count() == 0) throw error(ErrorKind::output, "{}: the picture has no pixels", format_or_name);
  if (const NonFinite at = find_non_finite(linear); at.found)
    throw error(ErrorKind::output,
                "{}: not written: pixel ({}, {}), channel {} is not a finite number; look for "
                "extreme numbers in the scene's materials and lights",
                format_or_name, at.x, at.y, at.channel);

  const Image image = with_writable_channels(format == "openexr" ? associated(linear) : linear, *writer);
  const bool is_float = format == "openexr" || format == "hdr";
  const bool layered = format == "openexr" && !image.layers.empty();
  OIIO::ImageSpec spec = make_spec(image, format, is_float, metadata);
  if (format == "openexr" && image.camera) {
    spec.attribute("worldtocamera", OIIO::TypeMatrix, image.camera->camera_from_world.data());
    spec.attribute("worldToNDC", OIIO::TypeMatrix, image.camera->ndc_from_world.data());
  }
  if (layered) {
    require_finite_layers(image, format_or_name);
    describe_layers(image, spec);
  }
  writer->threads(1);
  std::string file_name = "memory." + extension_of(format_or_name);  // JPEG 2000 and PNM have variants by extension
  if (writer->supports("ioproxy"))
    writer->set_ioproxy(&proxy);
  else
    file_name = file.emplace().path();

  const std::vector<uint8_t> codes = is_float ? std::vector<uint8_t>() : srgb8_from_linear(image);
  const std::vector<uint32_t> words = layered ? interleaved_with_layers(image) : std::vector<uint32_t>();
  const bool written =
      writer->open(file_name, spec) && (layered    ? writer->write_image(OIIO::TypeUnknown, words.data())
                                        : is_float ? writer->write_image(OIIO::TypeFloat, image.data.data())
                                                   : writer->write_image(OIIO::TypeUInt8, codes.data()));
  if (!writer->close() || !written)
    throw error(ErrorKind::output, "{}: cannot be encoded: {}; choose another format or size", format_or_name,
                one_line(writer->geterror()));
  if (file) bytes = file->contents();
  if (bytes.empty())
    throw error(ErrorKind::output, "{}: the encoder gave no bytes; choose another format", format_or_name);
  return bytes;
}

std::string image_library_version() { return OIIO_VERSION_STRING; }

}  // namespace hybridrt
