#pragma once

#include <fmt/format.h>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>

namespace hybridrt {

/// Whose fault an Error is; the command line turns it into an exit code.
enum class ErrorKind {
  usage,   ///< what was asked for cannot be done (an option's value, a pair of options)
  input,   ///< a scene, camera, image or settings file cannot be used
  device,  ///< no usable GL, a limit of the device, a shader that does not compile
  output,  ///< a file could not be written
};

/// `text` with its control characters, and what is no UTF-8, written as escapes: names from files may hold anything.
std::string in_one_line(std::string_view text);

/// A fault outside the program. The message says what, where (file, line or element) and what to do, in one line. Only
/// a device's own log may take more lines.
class [[nodiscard]] Error : public std::runtime_error {
 public:
  Error(ErrorKind kind, const std::string& message)
      : std::runtime_error(kind == ErrorKind::device ? message : in_one_line(message)), kind_(kind) {}
  ErrorKind kind() const { return kind_; }

 private:
  ErrorKind kind_;
};

/// `throw error(ErrorKind::input, "{}:{}: no such material {}", file, line, name)`
template <typename... Args>
Error error(ErrorKind kind, fmt::format_string<Args...> format, Args&&... args) {
  return Error(kind, fmt::format(format, std::forward<Args>(args)...));
}

}  // namespace hybridrt
