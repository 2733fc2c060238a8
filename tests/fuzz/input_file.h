#pragma once

#include <string>
#include <string_view>

#include "tests/support/temporary_folder.h"

namespace hybridrt::fuzz {

/// A file in its own folder: readers take paths, and follow names in the input to files beside it. Replaces the
/// previous input.
inline std::filesystem::path input_file(const char* name, std::string_view bytes) {
  static const TemporaryFolder folder;
  return folder.write(name, bytes);
}

}  // namespace hybridrt::fuzz
