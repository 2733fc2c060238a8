#include "core/scene/texture_name.h"

#include <algorithm>
#include <map>

#include "core/scene/text_scan.h"

namespace hybridrt {
namespace {

/// How many values an option has; negative: up to that many numbers.
const std::map<std::string_view, int> kOptions = {
    {"-blendu", 1}, {"-blendv", 1}, {"-bm", 1}, {"-boost", 1}, {"-cc", 1},     {"-clamp", 1}, {"-imfchan", 1},
    {"-mm", 2},     {"-o", -3},     {"-s", -3}, {"-t", -3},    {"-texres", 1}, {"-type", 1}};

/// Takes options with their values off the front of `rest`.
void pass_options(std::string_view& rest) {
  for (;;) {
    std::string_view after = rest;
    const auto option = kOptions.find(take_word(after));
    if (option == kOptions.end()) return;
    for (int value = 0; value < std::abs(option->second); ++value) {
      std::string_view peek = after;
      const std::string_view word = take_word(peek);
      if (option->second < 0 && !parse_number(word)) break;
      after = peek;
    }
    rest = after;
  }
}

}  // namespace

std::string texture_name(std::string_view statement) {
  pass_options(statement);
  statement = trimmed(statement);
  size_t end = statement.size();
  for (std::string_view rest = statement; !rest.empty();) {  // up to the first option behind the name
    const std::string_view word = take_word(rest);
    if (word.data() != statement.data() && kOptions.contains(word)) {
      end = static_cast<size_t>(word.data() - statement.data());
      break;
    }
  }
  return std::string(trimmed(statement.substr(0, end)));
}

TextureFile find_texture(const std::filesystem::path& folder, std::string name) {
  std::replace(name.begin(), name.end(), '\\', '/');
  const std::filesystem::path path(name);
  const bool has_drive = name.size() > 1 && name[1] == ':';
  TextureFile found;
  found.foreign = path.is_absolute() || has_drive || std::find(path.begin(), path.end(), "..") != path.end();
  std::error_code unreachable;
  const auto try_file = [&](const std::filesystem::path& candidate) {
    if (found.path.empty() && std::filesystem::is_regular_file(candidate, unreachable))
      found.path = candidate;
  };
  if (!found.foreign) try_file(folder / path);
  if (path.has_filename()) try_file(folder / path.filename());
  return found;
}

}  // namespace hybridrt
