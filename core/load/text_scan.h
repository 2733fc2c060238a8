#pragma once

#include <charconv>
#include <cmath>
#include <limits>
#include <optional>
#include <string>
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

inline std::string lower_case(std::string_view text) {
  std::string result(text);
  for (char& c : result)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  return result;
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

/// As parse_number, but takes the words of printf for what is no finite number ("nan", "-inf", "Infinity", "1.#QNAN"),
/// and takes what is too large for a double for infinite.
inline std::optional<double> parse_coordinate(std::string_view word) {
  if (const std::optional<double> number = parse_number(word)) return number;
  if (word.starts_with('-') || word.starts_with('+')) word.remove_prefix(1);
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  double value = 0;
  const auto [stop, status] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (status == std::errc::result_out_of_range && stop == word.data() + word.size()) return kInfinity;
  const std::string name = lower_case(word.substr(0, 9));
  if (name == "inf" || name == "infinity" || name.starts_with("1.#inf")) return kInfinity;
  if (name.starts_with("nan") || name.starts_with("1.#")) return std::numeric_limits<double>::quiet_NaN();
  return std::nullopt;
}

}  // namespace hybridrt
