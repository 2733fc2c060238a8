#include "tests/fuzz/reader.h"

#include <stdexcept>
#include <string>

#include "core/base/error.h"

namespace hybridrt::fuzz {

bool takes(std::string_view bytes) {
  try {
    read_input(bytes);
    return true;
  } catch (const Error& refused) {
    const std::string_view message = refused.what();
    if (refused.kind() != ErrorKind::input)
      throw std::logic_error("refused as what it is not: " + std::string(message));
    if (message.empty() || message.find('\n') != message.npos)
      throw std::logic_error("not one line: '" + std::string(message) + "'");
    return false;
  }
}

}  // namespace hybridrt::fuzz
