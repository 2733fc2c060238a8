#include "core/gl/extension_list.h"

#include <algorithm>

namespace hybridrt::gl {

bool lists_extension(const char* all, std::string_view name) {
  std::string_view rest = all ? all : "";
  while (!rest.empty()) {
    const size_t end = std::min(rest.find(' '), rest.size());
    if (rest.substr(0, end) == name) return true;
    rest.remove_prefix(std::min(end + 1, rest.size()));
  }
  return false;
}

}  // namespace hybridrt::gl
