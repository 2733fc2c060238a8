#pragma once

#include <string>
#include <string_view>

#include "core/base/error.h"

namespace hybridrt::cli {

/// First thing in main(). A standard stream that the caller closed becomes one that cannot be written: else the next
/// file that is opened takes its place and receives its text. Writing to a closed pipe or past a file size limit
/// becomes an error instead of death.
void prepare_standard_streams();

/// Writes to standard error. What cannot be written there is lost: telling how it goes must not change how it ends.
void say(std::string_view text) noexcept;

/// The line "hybridrt: MESSAGE" on standard error, as say(). Takes no memory.
void complain(std::string_view message) noexcept;

/// Throws Error output unless all that was printed on standard output has been taken. Results are what a command is
/// for: main() asks at the end of each.
void flush_output();

/// What flush_output() throws.
Error output_error(const std::string& reason);

}  // namespace hybridrt::cli
