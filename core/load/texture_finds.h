#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "core/base/warnings.h"
#include "core/load/find_file.h"

namespace hybridrt {

/// Finds the textures that a file names, and keeps what is to be told of their names.
class TextureFinds {
 public:
  /// `folders`: as for FileFinder.
  explicit TextureFinds(std::vector<std::filesystem::path> folders) : files_(std::move(folders)) {}

  /// The file, or an empty path. `line`: for messages; `is_read`: whether the texture will be used.
  const std::filesystem::path& find(std::string_view name, size_t line, bool is_read = true);

  /// A warning that lists the missing ones, another that lists those found under another name.
  void report(const std::filesystem::path& named_in, Warnings& warnings) const;

 private:
  FileFinder files_;
  NameList missing_, moved_;
  size_t first_missing_line_ = 0;
  std::string first_moved_to_;
};

}  // namespace hybridrt
