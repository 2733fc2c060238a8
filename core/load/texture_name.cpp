#include "core/load/texture_name.h"

#include <algorithm>
#include <map>
#include <vector>

#include "core/load/text_scan.h"

namespace hybridrt {
namespace {

/// How many values an option has; negative: up to that many numbers.
const std::map<std::string_view, int> kOptions = {
    {"-blendu", 1}, {"-blendv", 1}, {"-bm", 1}, {"-boost", 1}, {"-cc", 1},     {"-clamp", 1}, {"-imfchan", 1},
    {"-mm", 2},     {"-o", -3},     {"-s", -3}, {"-t", -3},    {"-texres", 1}, {"-type", 1}};

constexpr float kLargestNumber = 1e6f;

/// Applies an option with these values, if it is one that we read.
void apply_option(std::string_view option, const std::vector<std::string_view>& values, TextureMap& map) {
  const auto number = [&](size_t i, float& to) {
    if (i >= values.size()) return;
    if (const std::optional<double> read = parse_number(values[i]))
      to = std::clamp(static_cast<float>(*read), -kLargestNumber, kLargestNumber);
  };
  if (option == "-s") number(0, map.scale.x), number(1, map.scale.y);
  if (option == "-o") number(0, map.offset.x), number(1, map.offset.y);
  if (option == "-mm") number(0, map.base), number(1, map.gain);
  if (option == "-clamp" && !values.empty()) map.clamped = values[0] == "on";
  if (option == "-imfchan" && !values.empty() && std::string_view("rgbmlz").find(values[0]) != std::string_view::npos &&
      values[0].size() == 1)
    map.channel = values[0][0];
}

/// Takes options with their values off the front of `rest`.
void take_options(std::string_view& rest, TextureMap& map) {
  for (;;) {
    std::string_view after = rest;
    const auto option = kOptions.find(take_word(after));
    if (option == kOptions.end()) return;
    std::vector<std::string_view> values;
    for (int value = 0; value < std::abs(option->second); ++value) {
      std::string_view peek = after;
      const std::string_view word = take_word(peek);
      if (option->second < 0 && !parse_number(word)) break;
      values.push_back(word);
      after = peek;
    }
    apply_option(option->first, values, map);
    rest = after;
  }
}

}  // namespace

TextureStatement read_texture_statement(std::string_view statement) {
  TextureStatement read;
  take_options(statement, read.map);
  statement = trimmed(statement);
  size_t end = statement.size();
  std::string_view rest = statement;
  if (!rest.empty() && (rest[0] == '"' || rest[0] == '\''))  // a name in quotes ends where they end
    if (const size_t quote = rest.find(rest[0], 1); quote != rest.npos) rest.remove_prefix(quote + 1);
  while (!rest.empty()) {  // up to the first option after the name
    std::string_view options = rest;
    const std::string_view word = take_word(rest);
    if (word.data() != statement.data() && kOptions.contains(word)) {
      end = static_cast<size_t>(word.data() - statement.data());
      take_options(options, read.map);
      break;
    }
  }
  read.name = trimmed(statement.substr(0, end));
  if (read.name == "\"\"" || read.name == "''") read.name.clear();
  return read;
}

}  // namespace hybridrt
