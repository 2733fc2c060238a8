#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <string_view>

namespace hybridrt {

/// What a run is going to write, so that a second one at the same time can be refused. Each folder gets a hidden file
/// `.hybridrt.lock`; a file's name stands for a stretch of its bytes, a frame's number for one byte of that stretch,
/// and a run holds the kernel's locks on the bytes of its files. The kernel drops them when the process ends, however
/// it ends; what is left of a killed run is an empty file that the next run uses and removes.
///
/// Names are told apart by 31 bits of a hash: two names in 2^31 would be taken for one, and a run refused for nothing.
class FileClaims {
 public:
  enum class Answer {
    ours,     ///< claimed until this object's end
    taken,    ///< another process holds some of it
    unknown,  ///< the file system knows no locks: nobody would notice
  };

  FileClaims() = default;
  ~FileClaims();
  FileClaims(const FileClaims&) = delete;
  FileClaims& operator=(const FileClaims&) = delete;

  /// One file. Devices and pipes are nobody's. Throws as below.
  [[nodiscard]] Answer claim(const std::filesystem::path& file);

  /// Frames `first`..`last` (>= 0) of the files in `folder` that `name` stands for; equal names are the same files.
  /// The folder is made if it is missing. Throws Error(output) where that or writing to it fails.
  [[nodiscard]] Answer claim(const std::filesystem::path& folder, std::string_view name, int first, int last);

 private:
  [[nodiscard]] Answer lock(const std::filesystem::path& folder, int64_t start, int64_t length,
                            const std::filesystem::path& shown);

  std::map<std::filesystem::path, int> locks_;  ///< folder: descriptor of its lock file
};

}  // namespace hybridrt
