#include <algorithm>
#include <unordered_set>

#include "core/base/error.h"
#include "core/base/warnings.h"
#include "core/load/find_file.h"
#include "core/load/mtl_io.h"
#include "core/load/text_scan.h"

namespace hybridrt {
namespace {

namespace fs = std::filesystem;

constexpr size_t kMostWords = 64;  // per line; with more, names with blanks are not tried

struct Found {
  std::vector<fs::path> paths;
  std::vector<std::string> missing;
  NameList moved;  ///< found under another name
  std::string first_moved_to;
};

/// Whether a name ends with this word, for all that one can tell.
bool ends_a_name(std::string_view word) {
  while (word.ends_with('"') || word.ends_with('\'')) word.remove_suffix(1);
  return fold_case(word).ends_with(".mtl");
}

/// Splits one mtllib line into files: at each word the longest run of words that names a file as written, else the
/// longest up to a word that ends with .mtl that leads to one otherwise.
void find_libraries(FileFinder& files, std::string_view line, Found& found) {
  std::vector<std::string_view> words;
  for (std::string_view rest = line, word = take_word(rest); !word.empty(); word = take_word(rest))
    words.push_back(word);
  const auto run = [&](size_t begin, size_t end) {
    return std::string_view(words[begin].data(), words[end - 1].data() + words[end - 1].size());
  };
  for (size_t i = 0; i < words.size();) {
    const size_t most = words.size() <= kMostWords ? words.size() : i + 1;
    fs::path path;
    size_t end = most + 1;
    while (path.empty() && --end > i) path = files.find_as_written(run(i, end));
    if (path.empty()) {
      const auto last = std::find_if(words.begin() + i, words.begin() + most - 1, ends_a_name);
      end = static_cast<size_t>(last - words.begin()) + 2;
      while (path.empty() && --end > i)
        if (const FoundFile& file = files.find(run(i, end)); file.regular) path = file.path;
      if (!path.empty() && found.moved.count() == 0) found.first_moved_to = path.string();
      if (!path.empty()) found.moved.add(run(i, end));
    }
    if (path.empty()) {
      found.missing.emplace_back(words[i]);
      ++i;
    } else {
      found.paths.push_back(std::move(path));
      i = end;
    }
  }
}

}  // namespace

std::vector<Material> read_libraries(const fs::path& folder, const std::vector<std::string>& libraries,
                                     std::vector<std::string>& files, Warnings& warnings, const MaterialKinds& kinds) {
  Found found;
  FileFinder finder({folder});
  std::unordered_set<std::string> lines;  // exporters repeat the line before every object
  for (const std::string& line : libraries)
    if (lines.insert(line).second) find_libraries(finder, line, found);

  std::vector<Material> materials;
  std::unordered_set<std::string> read;
  for (const fs::path& path : found.paths) {
    if (!read.insert(path.string()).second) continue;
    read_mtl(path, materials, warnings, kinds, {folder});
    files.push_back(path.string());
  }
  if (!found.missing.empty())
    warnings.emplace_back(WarningCode::material_file_missing,
                          fmt::format("{} material files are missing (first: {}); their materials are drawn as default",
                                      found.missing.size(), in_quotes(found.missing.front())));
  if (found.moved.count() > 0)
    warnings.emplace_back(
        WarningCode::material_file_moved,
        fmt::format(
            "{} material files are not there as written; found by case, decoding or their last part ({}; first as {})",
            found.moved.count(), found.moved.text(), found.first_moved_to));

  std::unordered_set<std::string> names;
  const auto repeated = [&](const Material& material) { return !names.insert(material.name).second; };
  const size_t before = materials.size();
  const auto end = std::remove_if(materials.begin(), materials.end(), repeated);
  materials.erase(end, materials.end());
  if (materials.size() < before)
    warnings.emplace_back(WarningCode::material_repeated,
                          fmt::format("{} materials are defined again under a name that was taken; the first counts",
                                      before - materials.size()));
  return materials;
}

}  // namespace hybridrt
