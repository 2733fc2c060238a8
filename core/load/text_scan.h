#pragma once

#include <charconv>
#include <cmath>
#include <optional>
#include <string_view>

// Helpers for reading OBJ and MTL statements. Nothing here depends on the locale.

namespace hybridrt {

inline bool is_blank(char c) { return c == ' ' || c == '\t'; }
inline bool is_digit(char c) { return c >= '0' && c <= '9'; }

inline std::string_view trimmed(std::string_view text) {
  while (!text.empty() && is_blank(text.front())) text.remove_prefix(1);
  while (!text.empty() && is_blank(text.back())) text.remove_suffix(1);
  return text;
}

/// Takes the first blank-separated word off `text`; empty when there is none.
inline std::string_view take_word(std::string_view& text) {
  size_t begin = 0;
  while (begin < text.size() && is_blank(text[begin])) ++begin;
  size_t end = begin;
  while (end < text.size() && !is_blank(text[end])) ++end;
  const std::string_view word = text.substr(begin, end - begin);
  text.remove_prefix(end);
  return word;
}

/// The whole of `word` as a finite number, or nothing. A leading plus sign is allowed.
inline std::optional<double> parse_number(std::string_view word) {
  if (word.starts_with('+')) {
    word.remove_prefix(1);
    if (word.starts_with('-')) return std::nullopt;
  }
  double value = 0;
  const auto [stop, status] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (stop != word.data() + word.size() || word.empty()) return std::nullopt;
  if (status == std::errc::result_out_of_range)  // too small is as good as 0, too large is not a number
    return word.find("e-") != word.npos || word.find("E-") != word.npos ? std::optional<double>(0) : std::nullopt;
  if (status != std::errc() || !std::isfinite(value)) return std::nullopt;
  return value;
}

}  // namespace hybridrt
