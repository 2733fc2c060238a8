#include "core/load/find_file.h"

#include <algorithm>
#include <charconv>
#include <cwchar>
#include <cwctype>
#include <locale.h>
#include <set>

#include "core/load/text_scan.h"

namespace hybridrt {
namespace {

namespace fs = std::filesystem;

constexpr size_t kLongestName = 4096;  // PATH_MAX: no file has a longer one

bool is_regular(const fs::path& path) {
  std::error_code unreachable;
  return fs::is_regular_file(path, unreachable);
}

std::string with_slashes(std::string name) {
  std::replace(name.begin(), name.end(), '\\', '/');
  return name;
}

std::string without_quotes(std::string_view name) {
  name = trimmed(name);
  if (name.size() > 1 && (name.front() == '"' || name.front() == '\'') && name.back() == name.front())
    name = trimmed(name.substr(1, name.size() - 2));
  return std::string(name);
}

std::string percent_decoded(std::string_view name) {
  std::string decoded;
  for (size_t i = 0; i < name.size(); ++i) {
    unsigned code = 0;
    const char* const digits = name.data() + i + 1;
    const bool coded = name[i] == '%' && i + 2 < name.size() &&
                       std::from_chars(digits, digits + 2, code, 16).ptr == digits + 2 && code != 0;
    decoded += coded ? static_cast<char>(code) : name[i];
    if (coded) i += 2;
  }
  return decoded;
}

/// What the name may mean, each once, the most literal first.
std::vector<std::string> forms_of(const std::string& name) {
  std::vector<std::string> forms{name};
  const auto add = [&](std::string form) {
    if (std::find(forms.begin(), forms.end(), form) == forms.end()) forms.push_back(std::move(form));
  };
  add(with_slashes(name));
  add(with_slashes(without_quotes(name)));
  add(percent_decoded(forms.back()));
  return forms;
}

/// The folders and the file of a name, without "." and "x/..": a folder that is not there does not matter then.
std::vector<std::string> parts_of(const std::string& name) {
  std::vector<std::string> parts;
  for (const fs::path& part : fs::path(name).relative_path().lexically_normal())
    if (part != ".") parts.push_back(part.string());
  if (!parts.empty() && (parts.back().empty() || parts.back() == "..")) parts.clear();  // a folder, not a file
  return parts;
}

}  // namespace

std::string fold_case(std::string_view text) {
  std::string ascii(text);
  for (char& c : ascii)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c + ('a' - 'A'));
  if (std::all_of(text.begin(), text.end(), [](char c) { return static_cast<unsigned char>(c) < 128; })) return ascii;

  const locale_t utf8 = newlocale(LC_CTYPE_MASK, "C.UTF-8", nullptr);
  const locale_t before = utf8 ? uselocale(utf8) : nullptr;  // of this thread alone
  std::string lower;
  for (size_t i = 0; i < text.size();) {
    wchar_t wide = 0;
    std::mbstate_t reading{}, writing{};
    char bytes[16];
    const size_t size = std::mbrtowc(&wide, text.data() + i, text.size() - i, &reading);
    const bool known = size > 0 && size <= text.size() - i;
    const size_t written =
        known ? std::wcrtomb(bytes, static_cast<wchar_t>(std::towlower(static_cast<wint_t>(wide))), &writing) : 0;
    const bool usable = known && written <= sizeof bytes;
    if (usable)
      lower.append(bytes, written);
    else
      lower += text[i];
    i += usable ? size : 1;
  }
  if (utf8) uselocale(before), freelocale(utf8);
  return lower;
}

const FoundFile& FileFinder::find(std::string_view name) {
  const auto [answer, is_new] = answers_.try_emplace(std::string(name));
  if (is_new) answer->second = search(answer->first);
  return answer->second;
}

fs::path FileFinder::find_as_written(std::string_view name) const {
  if (name.empty() || name.size() > kLongestName) return {};
  for (const std::string& form : {std::string(name), with_slashes(std::string(name))})
    for (const fs::path& folder : folders_) {
      if (is_regular(folder / form)) return folder / form;
      const fs::path normal = (folder / fs::path(form)).lexically_normal();
      if (is_regular(normal)) return normal;
    }
  return {};
}

FoundFile FileFinder::search(const std::string& name) {
  FoundFile found{find_as_written(name)};
  found.as_written = !found.path.empty();
  if (found.as_written || name.empty() || name.size() > kLongestName) return found;

  std::vector<std::vector<std::string>> shorter;
  for (const std::string& form : forms_of(name)) {
    shorter.push_back(parts_of(form));
    found.path = walk_all(shorter.back(), fs::path(form).is_absolute());
    if (!found.path.empty()) return found;
  }
  for (std::vector<std::string>& parts : shorter)
    while (parts.size() > 1) {
      parts.erase(parts.begin());
      found.path = walk_all(parts, false);
      if (!found.path.empty()) return found;
    }

  found.regular = false;
  std::error_code unreachable;
  for (const fs::path& folder : folders_)
    if (found.path.empty() && fs::exists(folder / name, unreachable)) found.path = folder / name;
  return found;
}

fs::path FileFinder::walk_all(const std::vector<std::string>& parts, bool absolute) {
  if (parts.empty()) return {};
  if (absolute) return walk("/", parts, 0);
  for (const fs::path& folder : folders_)
    if (fs::path path = walk(folder, parts, 0); !path.empty()) return path;
  return {};
}

/// The first file below `folder` that parts[next..] name: the exact name of each part goes before all others.
fs::path FileFinder::walk(const fs::path& folder, const std::vector<std::string>& parts, size_t next) {
  const bool last = next + 1 == parts.size();
  const auto below = [&](const std::string& part) {
    const fs::path path = folder / part;
    std::error_code unreachable;
    if (last) return is_regular(path) ? path : fs::path();
    return fs::is_directory(path, unreachable) ? walk(path, parts, next + 1) : fs::path();
  };
  fs::path found = below(parts[next]);
  if (!found.empty() || parts[next] == "..") return found;
  const auto [begin, end] = list(folder).equal_range(fold_case(parts[next]));
  std::set<std::string> others;  // in the order of bytes
  for (auto entry = begin; entry != end; ++entry) others.insert(entry->second);
  for (const std::string& other : others)
    if (other != parts[next])
      if (found = below(other); !found.empty()) return found;
  return {};
}

const FileFinder::Listing& FileFinder::list(const fs::path& folder) {
  const auto [listing, is_new] = listings_.try_emplace(folder.string());
  if (!is_new) return listing->second;
  std::error_code unreadable;
  fs::directory_iterator entry(folder.empty() ? fs::path(".") : folder, unreadable);
  for (; !unreadable && entry != fs::directory_iterator(); entry.increment(unreadable)) {
    std::string name = entry->path().filename().string();
    std::string lower = fold_case(name);
    listing->second.emplace(std::move(lower), std::move(name));
  }
  return listing->second;
}

}  // namespace hybridrt
