#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <string>

namespace hybridrt {

/// A file's bytes, read where they are needed; zeros past its end, and for a file that cannot be opened.
class FileBytes {
 public:
  explicit FileBytes(const std::filesystem::path& path);
  uint64_t size() const { return size_; }
  std::string at(uint64_t place, size_t count);
  /// A number of `count` <= 8 bytes, its highest or lowest byte first.
  uint64_t big(uint64_t place, int count);
  uint64_t little(uint64_t place, int count);

 private:
  std::ifstream file_;
  uint64_t size_ = 0;
};

}  // namespace hybridrt
