#pragma once

#include <charconv>
#include <string>
#include <string_view>

#include "core/base/math.h"
#include "core/base/output_file.h"

namespace hybridrt {

/// One line of a text file, reused. Numbers have the fewest digits that read back the same.
class WrittenLine {
 public:
  explicit WrittenLine(OutputFile& file) : file_(file) {}
  WrittenLine& text(std::string_view text) { return line_ += text, *this; }
  template <typename Number>
  WrittenLine& number(Number value) {
    char digits[32];
    const auto [end, status] = std::to_chars(digits, digits + sizeof digits, value);
    line_.append(digits, end);
    return *this;
  }
  /// Its numbers, each after a blank.
  template <typename Vector>
  WrittenLine& vector(const Vector& v) {
    for (int axis = 0; axis < Vector::length(); ++axis) text(" ").number(v[axis]);
    return *this;
  }
  void end() {
    line_ += '\n';
    file_.write(line_);
    line_.clear();
  }

 private:
  OutputFile& file_;
  std::string line_;
};

}  // namespace hybridrt
