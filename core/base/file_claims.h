#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/base/temporary_names.h"

namespace hybridrt {

/// A file's name as claims see it: the last number before its extension apart from the rest.
struct NumberedName {
  std::string name;     ///< "x.#.png" of x.0007.png; as it is where there is no number
  int64_t number = -1;  ///< 7; -1 where there is none
};
NumberedName numbered_name(const std::filesystem::path& file);

/// What a run is going to write, so that a second one at the same time can be refused. Each folder gets a hidden file
/// `.hybridrt.lock`; a file's name, without its number, stands for a range of its bytes, the number for one byte of
/// that range, and a run holds kernel locks on the bytes of its files. The kernel drops them when the process ends,
/// however it ends. A killed run leaves an empty file, which the next run uses and removes, another user's too where
/// the folder allows that.
///
/// Names are told apart by 31 bits of a hash: one pair of names in 2^31 is taken for the same name, and a run is
/// refused needlessly.
class FileClaims {
 public:
  enum class Answer {
    ours,     ///< claimed until this object's end
    taken,    ///< another process holds some of it
    unknown,  ///< the file system has no locks: a clash would go unnoticed
  };

  FileClaims() = default;
  ~FileClaims();
  FileClaims(const FileClaims&) = delete;
  FileClaims& operator=(const FileClaims&) = delete;

  /// Claims one file. Devices, pipes and given descriptors need none. Throws as below.
  [[nodiscard]] Answer claim(const std::filesystem::path& file);

  /// Frames `first`..`last` (>= 0) of the files in `folder` that `name` stands for; equal names are the same files. A
  /// missing folder is created. Throws Error(output) if it cannot be created or written to.
  [[nodiscard]] Answer claim(const std::filesystem::path& folder, std::string_view name, int first, int last);

  /// Removes the temporary files (output_file.h) that killed runs have left of the files claimed here: nobody else
  /// writes these. Before the first is written.
  void remove_stale_temporaries() const;

 private:
  struct Folder {
    int descriptor = -1;                              ///< of its lock file
    std::unique_ptr<TemporaryName> name;              ///< of the lock file, until this object's end
    std::vector<std::pair<int64_t, int64_t>> ranges;  ///< first byte and length of each claim
  };
  [[nodiscard]] Answer lock(const std::filesystem::path& folder, int64_t start, int64_t length,
                            const std::filesystem::path& shown);

  std::map<std::filesystem::path, Folder> locks_;
};

}  // namespace hybridrt
