#include "core/image/image_metadata.h"

#include "core/base/check.h"

namespace hybridrt {

std::string description_of(const ImageMetadata& metadata) {
  std::string text;
  for (const auto& [name, value] : metadata) {
    HRT_CHECK(name.find_first_of("=\n") == std::string::npos && value.find('\n') == std::string::npos);
    if (!text.empty()) text += '\n';
    text += name + "=" + value;
  }
  return text;
}

}  // namespace hybridrt
