#pragma once

#include <string>
#include <string_view>

namespace hybridrt {

/// Once before any use of OpenImageIO: its own thread pools stay off, parallelism is the caller's.
/// Thread-safe.
void set_up_oiio();

/// OpenImageIO's pending messages as one line.
std::string one_line(std::string_view message);

}  // namespace hybridrt
