#include "core/image_io/read_image.h"

#include <new>
#include <string>
#include <system_error>

#include "core/base/error.h"
#include "core/image_io/image_formats.h"
#include "core/image_io/png_check.h"
#include "core/image_io/png_read.h"

namespace hybridrt {
namespace fs = std::filesystem;
namespace {

/// Checked here rather than by a library: OpenImageIO takes a name like "x.null" for a picture and waits on
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
                problem.what());
  }
}

}  // namespace

Image read_image(const fs::path& path) try {
  require_regular_file(path);
  return is_png(path) ? read_png(path) : image_formats(ErrorKind::input).read_format(path);
} catch (...) {
  throw_as_input_error(path);
}

std::string read_description(const fs::path& path) try {
  require_regular_file(path);
  return is_png(path) ? read_png_description(path) : image_formats(ErrorKind::input).read_format_description(path);
} catch (const Error&) {
  return "";
}

TexelSize texel_size(const fs::path& path, int largest_side_px, uint64_t most_texels) try {
  require_regular_file(path);
  return is_png(path) ? png_texel_size(path, largest_side_px, most_texels)
                      : image_formats(ErrorKind::input).read_format_texel_size(path, largest_side_px, most_texels);
} catch (...) {
  throw_as_input_error(path);
}

TexelImage read_texels(const fs::path& path, int largest_side_px, uint64_t most_texels) try {
  require_regular_file(path);
  return is_png(path) ? read_png_texels(path, largest_side_px, most_texels)
                      : image_formats(ErrorKind::input).read_format_texels(path, largest_side_px, most_texels);
} catch (...) {
  throw_as_input_error(path);
}

}  // namespace hybridrt
