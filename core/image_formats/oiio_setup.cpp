#include "core/image_formats/oiio_setup.h"

#include <OpenImageIO/imageio.h>
#include <algorithm>
#include <mutex>
#include <system_error>

#include "core/base/start_thread.h"

namespace hybridrt {

void set_up_oiio() {
  static std::once_flag once;
  std::call_once(once, [] {
    try {
      OIIO::attribute("threads", 1);
    } catch (const std::system_error& problem) {  // it first starts one thread per processor
      throw no_thread(problem);
    }
    OIIO::attribute("exr_threads", -1);  // 0 would mean one per processor
    OIIO::attribute("debug", 0);         // standard error is ours
  });
}

std::span<const char* const> picture_formats() {
  static constexpr const char* kFormats[] = {"jpeg", "openexr", "tiff", "bmp",      "targa", "hdr",
                                             "webp", "pnm",     "gif",  "jpeg2000", "fits"};
  return kFormats;
}

bool is_picture_format(std::string_view name) {
  const auto formats = picture_formats();
  return std::find(formats.begin(), formats.end(), name) != formats.end();
}

std::string one_line(std::string_view message) {
  while (!message.empty() && (message.back() == '\n' || message.back() == '\r')) message.remove_suffix(1);
  std::string line;
  for (const char c : message)
    if (c == '\n')
      line += "; ";
    else if (c != '\r')
      line += c;
  return line.empty() ? "no reason given" : line;
}

}  // namespace hybridrt
