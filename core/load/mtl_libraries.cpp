#include <algorithm>
#include <unordered_set>

#include "core/base/error.h"
#include "core/base/warnings.h"
#include "core/load/mtl_io.h"
#include "core/load/text_scan.h"

namespace hybridrt {
namespace {

namespace fs = std::filesystem;

constexpr size_t kMostWords = 64;  // per line; with more, names with blanks are not tried

/// The regular file that `name` means, or an empty path.
fs::path find_library(const fs::path& folder, std::string name) {
  const auto is_file = [](const fs::path& path) {
    std::error_code unreachable;
    return fs::is_regular_file(path, unreachable);
  };
  if (is_file(folder / name)) return folder / name;
  std::replace(name.begin(), name.end(), '\\', '/');
  if (is_file(folder / name)) return folder / name;
  const fs::path beside = folder / fs::path(name).filename();
  return is_file(beside) ? beside : fs::path();
}

/// Splits one mtllib line into files: at each word the longest run of words that names a file.
void find_libraries(const fs::path& folder, std::string_view line, std::vector<fs::path>& found,
                    std::vector<std::string>& missing) {
  std::vector<std::string_view> words;
  for (std::string_view rest = line, word = take_word(rest); !word.empty(); word = take_word(rest))
    words.push_back(word);
  for (size_t i = 0; i < words.size();) {
    size_t end = words.size() <= kMostWords ? words.size() : i + 1;
    fs::path path;
    for (; end > i; --end) {
      const char* stop = words[end - 1].data() + words[end - 1].size();
      path = find_library(folder, std::string(words[i].data(), stop));
      if (!path.empty()) break;
    }
    if (path.empty()) {
      missing.emplace_back(words[i]);
      ++i;
    } else {
      found.push_back(std::move(path));
      i = end;
    }
  }
}

}  // namespace

std::vector<Material> read_libraries(const fs::path& folder, const std::vector<std::string>& libraries,
                                     std::vector<std::string>& files, Warnings& warnings, const MaterialKinds& kinds) {
  std::vector<fs::path> found;
  std::vector<std::string> missing;
  std::unordered_set<std::string> lines;  // exporters repeat the line before every object
  for (const std::string& line : libraries)
    if (lines.insert(line).second) find_libraries(folder, line, found, missing);

  std::vector<Material> materials;
  std::unordered_set<std::string> read;
  for (const fs::path& path : found) {
    if (!read.insert(path.string()).second) continue;
    read_mtl(path, materials, warnings, kinds);
    files.push_back(path.string());
  }
  if (!missing.empty())
    warnings.push_back(fmt::format("{} material files are missing (first: {}); their materials are drawn as default",
                                   missing.size(), in_quotes(missing.front())));

  std::unordered_set<std::string> names;
  const auto repeated = [&](const Material& material) { return !names.insert(material.name).second; };
  const size_t before = materials.size();
  const auto end = std::remove_if(materials.begin(), materials.end(), repeated);
  materials.erase(end, materials.end());
  if (materials.size() < before)
    warnings.push_back(fmt::format("{} materials are defined again under a name that was taken; the first counts",
                                   before - materials.size()));
  return materials;
}

}  // namespace hybridrt
