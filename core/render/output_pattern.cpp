#include "core/render/output_pattern.h"

#include <algorithm>
#include <optional>

#include "core/base/error.h"

namespace hybridrt {
namespace {

struct Placeholder {
  size_t begin = 0, length = 0;
  int digits = 1;
};

/// `{frame}`, `{frame:4}` or `{frame:04}` at `begin`; throws for anything else that begins with `{frame`.
std::optional<Placeholder> braces_at(const std::string& text, size_t begin) {
  constexpr std::string_view kWord = "{frame";
  if (text.compare(begin, kWord.size(), kWord) != 0) return std::nullopt;
  const size_t end = text.find('}', begin);
  std::string_view rest(text);
  rest = rest.substr(begin + kWord.size(), std::min(end, text.size()) - begin - kWord.size());
  Placeholder found{begin, end - begin + 1, 1};
  bool valid = end != std::string::npos;
  if (!rest.empty()) {
    const std::string_view number = rest.substr(1);
    valid = valid && rest[0] == ':' && !number.empty() && number.size() <= 2 &&
            std::all_of(number.begin(), number.end(), [](char c) { return c >= '0' && c <= '9'; });
    if (valid) found.digits = std::max(1, std::stoi(std::string(number)));
  }
  if (!valid)
    throw error(ErrorKind::usage, "output '{}': '{}' is not a placeholder; write ####, {{frame}} or {{frame:04}}", text,
                text.substr(begin, end == std::string::npos ? end : found.length));
  return found;
}

/// `%d` or `%04d` at `begin`, as printf writes numbers.
std::optional<Placeholder> percent_at(const std::string& text, size_t begin) {
  const size_t end = text.find_first_not_of("0123456789", begin + 1);
  if (text[begin] != '%' || end == std::string::npos || text[end] != 'd' || end > begin + 3) return std::nullopt;
  const std::string digits = text.substr(begin + 1, end - begin - 1);
  return Placeholder{begin, end + 1 - begin, digits.empty() ? 1 : std::max(1, std::stoi(digits))};
}

/// Marks of other programs, which would end up in a file's name as they are.
void refuse_foreign_marks(const std::string& text, const std::string& name) {
  for (const char* mark : {"$F", "@"})
    if (const size_t at = name.find(mark); at != std::string::npos)
      throw error(ErrorKind::usage, "output '{}': '{}' is not a placeholder for several frames; write ####, as in {}",
                  text, mark, name.substr(0, at) + "####" + name.substr(std::min(name.size(), name.find_last_of('.'))));
}

std::optional<Placeholder> next_placeholder(const std::string& text, size_t from, bool hashes_count) {
  for (size_t i = from; i < text.size(); ++i) {
    if (hashes_count && text[i] == '#') {
      const size_t end = std::min(text.find_first_not_of('#', i), text.size());
      return Placeholder{i, end - i, static_cast<int>(end - i)};
    }
    if (const auto found = braces_at(text, i)) return found;
    if (const auto found = percent_at(text, i)) return found;
  }
  return std::nullopt;
}

/// `text` with each placeholder replaced by `number(digits)`.
template <typename Number>
std::string expand(const std::string& text, bool hashes_count, const Number& number) {
  std::string result;
  size_t at = 0;
  while (const auto found = next_placeholder(text, at, hashes_count)) {
    result += text.substr(at, found->begin - at) + number(found->digits);
    at = found->begin + found->length;
  }
  return result + text.substr(at);
}

/// The length of the part of pattern.folder that is the same for all frames: up to and including a '/', or nothing.
size_t common_length(const OutputPattern& pattern) {
  const auto varies = next_placeholder(pattern.folder, 0, false);
  return varies ? pattern.folder.rfind('/', varies->begin) + 1 : pattern.folder.size();  // npos + 1 is 0
}

size_t extension_begin(const std::string& name) {
  return name.size() - std::filesystem::path(name).extension().string().size();
}

/// The AOV takes the separator that the number has: `a_####.png` -> `a_depth_####.png`.
std::string with_aov(std::string name, std::string_view aov) {
  std::optional<Placeholder> last;
  for (auto found = next_placeholder(name, 0, true); found;
       found = next_placeholder(name, last->begin + last->length, true))
    last = found;
  if (!last) return name.insert(extension_begin(name), fmt::format(".{}", aov));
  if (last->begin == 0) return fmt::format("{}.{}", aov, name);
  const char before = name[last->begin - 1];
  const bool separated = before == '.' || before == '_' || before == '-';
  return name.insert(last->begin, separated ? fmt::format("{}{}", aov, before) : fmt::format(".{}.", aov));
}

}  // namespace

OutputPattern parse_output_pattern(const std::string& text, bool several_frames) {
  const size_t slash = text.rfind('/');
  const size_t name_begin = slash == std::string::npos ? 0 : slash + 1;
  OutputPattern pattern{text.substr(0, name_begin), text.substr(name_begin)};
  if (pattern.name.empty() || pattern.name == "." || pattern.name == "..")
    throw error(ErrorKind::usage, "output '{}' names a folder; add a file name, as in {}name.####.png", text,
                pattern.folder);
  const bool numbered =
      next_placeholder(pattern.folder, 0, false).has_value() | next_placeholder(pattern.name, 0, true).has_value();
  if (several_frames && !numbered) refuse_foreign_marks(text, pattern.name);
  if (several_frames && !numbered) pattern.name.insert(extension_begin(pattern.name), ".####");
  return pattern;
}

std::filesystem::path output_path(const OutputPattern& pattern, int64_t frame, std::string_view aov) {
  const std::string name = aov.empty() ? pattern.name : with_aov(pattern.name, aov);
  const auto number = [frame](int digits) { return fmt::format("{:0{}d}", frame, digits); };
  return expand(pattern.folder, false, number) + expand(name, true, number);
}

std::string stem_of(const OutputPattern& pattern) {
  const std::string name = std::filesystem::path(expand(pattern.name, true, [](int) { return ""; })).stem().string();
  const size_t end = name.find_last_not_of(" ._-");
  return end == std::string::npos ? "frames" : name.substr(0, end + 1);
}

std::filesystem::path common_folder(const OutputPattern& pattern) {
  const std::filesystem::path folder = pattern.folder.substr(0, common_length(pattern));
  if (folder.empty()) return ".";
  return folder.has_relative_path() ? folder.parent_path() : folder;  // without the '/' at its end
}

std::string name_below(const OutputPattern& pattern) {
  const auto number = [](int) { return "#"; };
  return expand(pattern.folder.substr(common_length(pattern)), false, number) + expand(pattern.name, true, number);
}

}  // namespace hybridrt
