#include "core/image_formats/read_format.h"

#include <OpenImageIO/imageio.h>
#include <algorithm>
#include <memory>
#include <mutex>
#include <new>
#include <string>
#include <system_error>
#include <utility>

#include "core/base/error.h"
#include "core/image/srgb.h"
#include "core/image_formats/oiio_setup.h"
#include "core/image_formats/unused_alpha.h"
#include "core/image_io/header_check.h"
#include "core/image_io/image_limits.h"
#include "core/image_io/texel_of.h"

namespace hybridrt {
namespace fs = std::filesystem;
namespace {

using Input = std::unique_ptr<OIIO::ImageInput>;

void require_size(const fs::path& path, const OIIO::ImageSpec& spec) {
  if (spec.deep || spec.depth > 1)
    throw error(ErrorKind::input, "{}: deep and volume images are not supported; flatten it first", path.string());
  require_readable_size(path, spec.width, spec.height, spec.nchannels);
}

/// The reader for the extension, else the one that recognises the contents: pictures with a wrong extension are common.
/// OpenImageIO's own search would also try its film, volume and raw camera readers.
Input find_reader(const fs::path& path, std::string& problem) {
  OIIO::ImageSpec as_stored;
  as_stored.attribute("oiio:UnassociatedAlpha", 1);  // else colours are premultiplied by alpha
  const auto opened = [&](Input reader) -> Input {
    OIIO::ImageSpec spec;
    if (reader && is_picture_format(reader->format_name()) && reader->open(path.string(), spec, as_stored))
      return reader;
    if (reader && reader->has_error() && problem.empty()) problem = one_line(reader->geterror());
    OIIO::geterror();  // cleared, or OpenImageIO prints it at exit
    return nullptr;
  };

  const std::string extension = path.extension().string();
  if (extension.size() > 1)
    if (Input reader = opened(OIIO::ImageInput::create(extension.substr(1)))) return reader;
  for (const char* format : picture_formats()) {
    Input reader = OIIO::ImageInput::create(format);
    if (reader && reader->valid_file(path.string()))
      if (Input found = opened(std::move(reader))) return found;
  }
  return nullptr;
}

constexpr TexelLimits kImageLimits{kMaxImageSidePx, static_cast<uint64_t>(kMaxImagePixels)};

/// What may be opened, as its header says.
HeaderClaim require_openable(const fs::path& path, const TexelLimits& limits) {
  HeaderClaim claim = header_claim(path, limits);
  if (!claim.fault.empty())
    throw error(ErrorKind::input, "{}: cannot be read: {}; write it again, or use a smaller image", path.string(),
                claim.fault);
  return claim;
}

Input open_image(const fs::path& path) {
  set_up_oiio();
  std::string problem;
  Input input;
  {
    // One header at a time, whatever the format: OpenImageIO 2.4 looks up tags of ICC profiles in maps that all its
    // readers share, inserts those that it does not know, and takes no lock (its issue 3756, pull request 3767). It
    // guards everything else that its readers and writers share, so pixels are read in parallel.
    static std::mutex reading_header;
    const std::lock_guard lock(reading_header);
    input = find_reader(path, problem);
  }
  if (!input)
    throw error(ErrorKind::input, "{}: not a readable image: {}; use a whole PNG, JPEG, EXR, TIFF or the like",
                path.string(), problem.empty() ? "unknown format" : problem);
  input->threads(1);
  require_size(path, input->spec());
  return input;
}

/// Readers may say that rows were read and leave a message all the same: JPEG's, as libjpeg fills what is missing with
/// grey, and TIFF's, whose strips stay black, or not, as they are packed. Only a JPEG is used in spite of it.
bool is_broken(const OIIO::ImageInput& input) {
  return input.has_error() && input.format_name() != std::string_view("jpeg");
}

[[noreturn]] void throw_broken(const fs::path& path, int row, OIIO::ImageInput& input) {
  throw error(ErrorKind::input, "{}: broken image, row {} and on: {}; write or copy it again", path.string(), row,
              one_line(input.geterror()));
}

/// Reads strip by strip into reserved memory: a file that is cut short fails before most of it is touched.
Image read_pixels(const fs::path& path, OIIO::ImageInput& input) {
  const OIIO::ImageSpec spec = input.spec();
  Image image;
  image.width_px = spec.width, image.height_px = spec.height, image.channels = spec.nchannels;
  const size_t row_values = static_cast<size_t>(spec.width) * spec.nchannels;
  image.data.reserve(row_values * spec.height);
  const int strip = spec.tile_width > 0 ? spec.height : 64;
  for (int y = 0; y < spec.height; y += strip) {
    const int rows = std::min(strip, spec.height - y);
    image.data.resize(image.data.size() + row_values * rows);
    float* target = image.data.data() + row_values * y;
    const bool read = spec.tile_width > 0 ? input.read_image(0, 0, 0, spec.nchannels, OIIO::TypeFloat, target)
                                          : input.read_scanlines(0, 0, spec.y + y, spec.y + y + rows, 0, 0,
                                                                 spec.nchannels, OIIO::TypeFloat, target);
    if (!read || input.has_error()) throw_broken(path, y, input);
  }
  return image;
}

/// What the reader says of rows that it gave, without the file's name; "" if nothing.
std::string complaint(const fs::path& path, const OIIO::ImageInput& input) {
  if (!input.has_error()) return "";
  std::string text = one_line(input.geterror());
  const std::string name = " (\"" + path.string() + "\")";
  if (text.ends_with(name)) text.resize(text.size() - name.size());
  return text;
}

/// Converts rows of the file's numbers to display codes, strip by strip as in read_pixels.
TexelImage read_codes(const fs::path& path, OIIO::ImageInput& input) {
  const OIIO::ImageSpec spec = input.spec();
  const int channels = std::min(spec.nchannels, 4);
  const bool floats = spec.format.is_floating_point();
  TexelImage image;
  image.width_px = spec.width, image.height_px = spec.height;
  image.has_alpha = alpha_channel(channels) >= 0 && !says_alpha_is_unused(path, input.format_name());
  image.texels.reserve(static_cast<size_t>(spec.width) * spec.height);
  const int strip = spec.tile_width > 0 ? std::max(spec.tile_height, 1) : 64;
  Image linear;
  std::vector<uint8_t> codes;
  for (int y = 0; y < spec.height; y += strip) {
    const int rows = std::min(strip, spec.height - y);
    const size_t values = static_cast<size_t>(spec.width) * rows * channels;
    codes.resize(values);
    if (floats) linear = Image(spec.width, rows, channels);
    void* const target = floats ? static_cast<void*>(linear.data.data()) : codes.data();
    const OIIO::TypeDesc type = floats ? OIIO::TypeFloat : OIIO::TypeUInt8;
    const bool read = spec.tile_width > 0
                          ? input.read_tiles(0, 0, spec.x, spec.x + spec.width, spec.y + y, spec.y + y + rows, spec.z,
                                             spec.z + 1, 0, channels, type, target)
                          : input.read_scanlines(0, 0, spec.y + y, spec.y + y + rows, 0, 0, channels, type, target);
    if (!read || is_broken(input)) throw_broken(path, y, input);
    if (floats) codes = srgb8_from_linear(linear);
    const uint32_t opaque = image.has_alpha ? 0 : 0xFF000000u;
    for (size_t i = 0; i < values; i += channels) image.texels.push_back(texel_of(&codes[i], channels) | opaque);
  }
  image.damage = complaint(path, input);
  return image;
}

/// The texels, the reader's own copies of the file and of its pixels, and a strip of read_codes().
uint64_t decoding_bytes(const fs::path& path, const OIIO::ImageSpec& spec) {
  constexpr uint64_t kBytesPerTexel = 4, kBytesPerStripValue = 9;
  const auto width = static_cast<uint64_t>(spec.width), height = static_cast<uint64_t>(spec.height);
  const uint64_t strip = spec.tile_width > 0 ? static_cast<uint64_t>(std::max(spec.tile_height, 1)) : 64;
  return width * height * kBytesPerTexel + fs::file_size(path) + spec.image_bytes(true) +
         width * std::min(strip, height) * static_cast<uint64_t>(std::min(spec.nchannels, 4)) * kBytesPerStripValue;
}

}  // namespace

Image read_format(const fs::path& path) {
  require_openable(path, kImageLimits);
  const Input input = open_image(path);
  return read_pixels(path, *input);
}

std::string read_format_description(const fs::path& path) {
  require_openable(path, kImageLimits);
  return open_image(path)->spec().get_string_attribute("ImageDescription");
}

TexelSize read_format_texel_size(const fs::path& path, int largest_side_px, uint64_t most_texels) {
  const TexelLimits limits{largest_side_px, most_texels};
  const HeaderClaim claim = require_openable(path, limits);
  if (claim.decoding_bytes > 0)
    return {static_cast<int>(claim.width_px), static_cast<int>(claim.height_px), claim.decoding_bytes};
  const Input input = open_image(path);
  const OIIO::ImageSpec& spec = input->spec();
  require_texel_size(path, spec.width, spec.height, limits);
  return {spec.width, spec.height, decoding_bytes(path, spec)};
}

TexelImage read_format_texels(const fs::path& path, int largest_side_px, uint64_t most_texels) {
  const TexelLimits limits{largest_side_px, most_texels};
  require_openable(path, limits);
  const Input input = open_image(path);
  require_texel_size(path, input->spec().width, input->spec().height, limits);
  return read_codes(path, *input);
}

}  // namespace hybridrt
