#pragma once

#include <charconv>

namespace hybridrt {

/// The number with the fewest digits that reads back as the same float: 0.1, not 0.10000000149.
inline double shortest_double(float value) {
  char digits[32];
  const char* const end = std::to_chars(digits, digits + sizeof digits, value).ptr;
  double number = 0;
  std::from_chars(digits, end, number);
  return number;
}

}  // namespace hybridrt
