#include "core/base/error.h"

#include <algorithm>

namespace hybridrt {

namespace {

/// The length of the well-formed UTF-8 character at the start of `text`; 0 if there is none. Source: Unicode 15, table
/// 3-7.
size_t utf8_length(std::string_view text) {
  const auto byte = [&](size_t i) { return i < text.size() ? static_cast<unsigned char>(text[i]) : 0u; };
  const auto follows = [&](size_t i) { return (byte(i) & 0xC0u) == 0x80u; };
  const unsigned first = byte(0), second = byte(1);
  if (first < 0x80) return 1;
  if (first >= 0xC2 && first <= 0xDF) return follows(1) ? 2 : 0;
  if (first >= 0xE0 && first <= 0xEF) {
    const bool allowed = follows(1) && !(first == 0xE0 && second < 0xA0) && !(first == 0xED && second > 0x9F);
    return allowed && follows(2) ? 3 : 0;
  }
  if (first >= 0xF0 && first <= 0xF4) {
    const bool allowed = follows(1) && !(first == 0xF0 && second < 0x90) && !(first == 0xF4 && second > 0x8F);
    return allowed && follows(2) && follows(3) ? 4 : 0;
  }
  return 0;
}

/// The control characters above ASCII, U+0080 to U+009F: terminals obey them too.
bool is_late_control(std::string_view character) {
  return character.size() == 2 && character[0] == '\xC2' && static_cast<unsigned char>(character[1]) < 0xA0;
}

}  // namespace

std::string in_one_line(std::string_view text) {
  std::string line;
  while (!text.empty()) {
    const size_t length = utf8_length(text);
    const std::string_view character = text.substr(0, std::max<size_t>(length, 1));
    const auto first = static_cast<unsigned char>(character[0]);
    if (character == "\n")
      line += "\\n";
    else if (length == 0 || first < 0x20 || first == 0x7f || is_late_control(character))
      for (const char c : character) line += fmt::format("\\x{:02x}", static_cast<unsigned char>(c));
    else
      line += character;
    text.remove_prefix(character.size());
  }
  return line;
}

}  // namespace hybridrt
