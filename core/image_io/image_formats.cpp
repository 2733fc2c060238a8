#include "core/image_io/image_formats.h"

#include <dlfcn.h>
#include <system_error>

namespace hybridrt {
namespace {

namespace fs = std::filesystem;

const ImageFormats* open_image_formats(ErrorKind kind) {
  std::error_code unknown;
  const fs::path program = fs::read_symlink("/proc/self/exe", unknown);
  const fs::path file = (program.parent_path() / HYBRIDRT_IMAGE_FORMATS).lexically_normal();
  const auto problem = [&] {
    const char* reason = ::dlerror();
    return error(kind,
                 "{}: cannot be opened, and no picture but a PNG (and an EXR that is written) works without it: {}; "
                 "install all of hybridrt again",
                 file.string(), reason ? reason : "unknown reason");
  };
  // Never closed: OpenImageIO's threads and caches end with the program.
  void* const library = ::dlopen(file.c_str(), RTLD_NOW | RTLD_LOCAL);
  if (!library) throw problem();
  const auto get = reinterpret_cast<const ImageFormats* (*)()>(::dlsym(library, kImageFormatsSymbol));
  if (!get) throw problem();
  return get();
}

}  // namespace

const ImageFormats& image_formats(ErrorKind kind) {
  static const ImageFormats* const formats = open_image_formats(kind);
  return *formats;
}

}  // namespace hybridrt
