#include "core/image_io/read_image.h"

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
#include "core/image_io/oiio_setup.h"
#include "core/image_io/png_check.h"
#include "core/image_io/unused_alpha.h"

namespace hybridrt {
namespace fs = std::filesystem;
namespace {

using Input = std::unique_ptr<OIIO::ImageInput>;

/// Checked here rather than by OpenImageIO, which takes a name like "x.null" for a picture and waits on
/// pipes.
void require_regular_file(const fs::path& path) {
  std::error_code problem;
  const fs::file_status status = fs::status(path, problem);
  if (status.type() == fs::file_type::not_found)
    throw error(ErrorKind::input, "{}: no such image file; check the path", path.string());
  if (problem)
    throw error(ErrorKind::input, "{}: cannot be read: {}; check the path and its permissions", path.string(),
                problem.message());
  if (!fs::is_regular_file(status))
    throw error(ErrorKind::input, "{}: is {}, not an image file; name the file itself", path.string(),
                fs::is_directory(status) ? "a folder" : "a device or pipe");
  if (fs::file_size(path, problem) == 0)  // also files of /proc, some of which wait as pipes do
    throw error(ErrorKind::input, "{}: not a readable image: the file is empty; write or copy it again", path.string());
}

void require_size(const fs::path& path, const OIIO::ImageSpec& spec) {
  if (spec.deep || spec.depth > 1)
    throw error(ErrorKind::input, "{}: deep and volume images are not supported; flatten it first", path.string());
  if (spec.width < 1 || spec.height < 1 || spec.nchannels < 1)
    throw error(ErrorKind::input, "{}: holds no pixels; write the image again", path.string());
  if (spec.width > kMaxImageSidePx || spec.height > kMaxImageSidePx ||
      static_cast<double>(spec.width) * spec.height > kMaxImagePixels || spec.nchannels > 1024)
    throw error(ErrorKind::input, "{}: {}x{} pixels with {} channels is too large; at most {} on a side and {} in all",
                path.string(), spec.width, spec.height, spec.nchannels, kMaxImageSidePx, kMaxImagePixels);
}

/// The reader for the extension, else the one that recognises the contents: pictures with a wrong extension are common.
/// OpenImageIO's own search would also try its film, volume and raw camera readers.
Input find_reader(const fs::path& path, std::string& problem) {
  OIIO::ImageSpec as_stored;
  as_stored.attribute("oiio:UnassociatedAlpha", 1);  // else PNG colours are premultiplied by alpha
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

Input open_image(const fs::path& path) {
  require_regular_file(path);
  if (const std::string fault = png_fault(path); !fault.empty())
    throw error(ErrorKind::input, "{}: broken image: {}; write or copy it again", path.string(), fault);
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
    if (!read)
      throw error(ErrorKind::input, "{}: broken image, row {} and on: {}; write or copy it again", path.string(), y,
                  one_line(input.geterror()));
  }
  return image;
}

/// A pixel's 8-bit channels as a texel.
uint32_t texel_of(const uint8_t* codes, int channels) {
  const uint32_t red = codes[0], green = channels > 2 ? codes[1] : red, blue = channels > 2 ? codes[2] : red;
  const int alpha = alpha_channel(channels);
  return red | green << 8 | blue << 16 | (alpha >= 0 ? uint32_t{codes[alpha]} : 255u) << 24;
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
    if (!read)
      throw error(ErrorKind::input, "{}: broken image, row {} and on: {}; write or copy it again", path.string(), y,
                  one_line(input.geterror()));
    if (floats) codes = srgb8_from_linear(linear);
    const uint32_t opaque = image.has_alpha ? 0 : 0xFF000000u;
    for (size_t i = 0; i < values; i += channels) image.texels.push_back(texel_of(&codes[i], channels) | opaque);
  }
  return image;
}

/// Turns whatever a library throws into an Error(input) about the file.
[[noreturn]] void throw_as_input_error(const fs::path& path) {
  try {
    throw;
  } catch (const Error&) {
    throw;
  } catch (const std::bad_alloc&) {
    throw error(ErrorKind::input, "{}: too large for the memory; use a smaller image", path.string());
  } catch (const std::exception& problem) {
    throw error(ErrorKind::input, "{}: not a readable image: {}; write or copy it again", path.string(),
                one_line(problem.what()));
  }
}

}  // namespace

Image read_image(const fs::path& path) try {
  const Input input = open_image(path);
  return read_pixels(path, *input);
} catch (...) {
  throw_as_input_error(path);
}

std::string read_description(const fs::path& path) try {
  return open_image(path)->spec().get_string_attribute("ImageDescription");
} catch (const Error&) {
  return "";
}

TexelImage read_texels(const fs::path& path, int largest_side_px, uint64_t most_texels) try {
  const Input input = open_image(path);
  const OIIO::ImageSpec& spec = input->spec();
  if (spec.width > largest_side_px || spec.height > largest_side_px ||
      static_cast<uint64_t>(spec.width) * static_cast<uint64_t>(spec.height) > most_texels)
    throw error(ErrorKind::input, "{}: {}x{} pixels are too large for a texture; at most {} on a side and {} in all",
                path.string(), spec.width, spec.height, largest_side_px, most_texels);
  return read_codes(path, *input);
} catch (...) {
  throw_as_input_error(path);
}

}  // namespace hybridrt
