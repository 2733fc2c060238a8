#pragma once

#include <string>
#include <string_view>

#include "core/base/error.h"

namespace hybridrt::cli {

/// Must come first in main(). A standard stream that the caller closed is replaced by one that cannot be used: else the
/// next file that is opened would take its number and receive its text. Writing to a closed pipe or past a file size
/// limit becomes an error instead of a fatal signal.
void prepare_standard_streams();

/// Writes to standard error. What cannot be written there is lost: progress messages must not change the exit code.
void say(std::string_view text) noexcept;

/// Writes the line "hybridrt: MESSAGE" to standard error, as say(). Allocates no memory.
void complain(std::string_view message) noexcept;

/// Throws Error(output) unless everything printed to standard output was written. main() calls it after each command.
void flush_output();

/// The error that flush_output() throws.
Error output_error(const std::string& reason);

}  // namespace hybridrt::cli
