#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

namespace hybridrt {

/// A file that another file names.
struct FoundFile {
  std::filesystem::path path;  ///< empty: there is no such file
  bool as_written = false;     ///< its name leads there, backslashes taken for slashes; else it was found otherwise
  bool regular = true;         ///< false: the name leads to a folder, a pipe or a device
};

/// Finds files by the names that an MTL, OBJ or PLY gives them, which may come from another system.
///  - The name as it is written, in each of the folders in turn. Absolute names and `..` are followed.
///  - Else the name ignoring case, folder by folder; of several files the first by bytes counts. After that without
///    the quotes around it, then with %20 and the like decoded.
///  - Else the name without its first folder in the same way, then without its second, and so on to the bare name.
///  - Only regular files count; nothing is opened. Where there is none but the name as written is a folder, a pipe or a
///    device, that is returned.
/// Answers and the listings of folders are kept: make one for a few files that belong together.
class FileFinder {
 public:
  /// `folders`: where relative names begin, the first one first.
  explicit FileFinder(std::vector<std::filesystem::path> folders) : folders_(std::move(folders)) {}

  const FoundFile& find(std::string_view name);
  /// The name as written and nothing else; an empty path if no regular file is there.
  std::filesystem::path find_as_written(std::string_view name) const;

 private:
  using Listing = std::multimap<std::string, std::string>;  ///< the names in a folder by their lower case

  FoundFile search(const std::string& name);
  std::filesystem::path walk(const std::filesystem::path& folder, const std::vector<std::string>& parts, size_t next);
  std::filesystem::path walk_all(const std::vector<std::string>& parts, bool absolute);
  const Listing& list(const std::filesystem::path& folder);

  std::vector<std::filesystem::path> folders_;
  std::unordered_map<std::string, FoundFile> answers_;
  std::unordered_map<std::string, Listing> listings_;
};

/// `text` in lower case where it is UTF-8, whatever the locale; other bytes stay.
std::string fold_case(std::string_view text);

}  // namespace hybridrt
