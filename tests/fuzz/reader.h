#pragma once

#include <string_view>

namespace hybridrt::fuzz {

/// One reader of hostile bytes; each fuzz_NAME.cpp defines it. Throws Error for what it refuses; anything else that
/// happens (another exception, a fault that a sanitizer sees, no end) is a bug of the reader.
void read_input(std::string_view bytes);

/// Throws std::logic_error unless the reader accepts the input or refuses it in one line. True if it accepts it.
bool takes(std::string_view bytes);

}  // namespace hybridrt::fuzz
