#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace hybridrt {

/// What tells a file from all others, whatever it is called: device and inode where it exists, with symbolic links
/// followed, else the path that it will have. Empty for devices (/dev/null), which keep nothing.
std::string file_identity(const std::filesystem::path& path);

/// The files that a run reads and those that it is going to write, collected before it writes the first: none may be
/// written over that is read, and none twice. By identity, so that links and detours do not matter.
class RunFiles {
 public:
  void reads(const std::filesystem::path& path);

  /// `what`: what is written there, like "--timings". Throws Error(usage) if the file is among those that are read or
  /// written.
  void writes(const std::filesystem::path& path, std::string_view what);

  /// Throws as writes(), without taking the file in.
  void require_unused(const std::filesystem::path& path, std::string_view what) const;

  /// Every file so far, as it was named.
  std::vector<std::filesystem::path> paths() const;

 private:
  struct Use {
    std::filesystem::path path;
    std::string what;  ///< empty: it is read
  };
  std::map<std::string, Use> uses_;  ///< by identity
};

}  // namespace hybridrt
