#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

namespace hybridrt {

/// A file that appears under its final name only when it is whole: written beside it under a temporary
/// name, then fsync and rename. Missing folders are created. An existing file is replaced. Unless
/// commit() was called and returned, nothing is left behind (a killed process may leave the temporary).
///
/// Every function throws Error (output), naming the file and the reason: disk full, read-only, a folder
/// or device where the file should go. Not thread-safe. Neither copied nor moved.
class OutputFile {
 public:
  explicit OutputFile(const std::filesystem::path& path);
  ~OutputFile();
  OutputFile(const OutputFile&) = delete;
  OutputFile& operator=(const OutputFile&) = delete;

  /// Buffered.
  void write(std::string_view bytes) {
    if (buffer_.size() + bytes.size() > kBuffer) flush();
    if (bytes.size() > kBuffer) return write_through(bytes);
    buffer_ += bytes;
  }
  /// Makes the file appear.
  void commit();
  uint64_t bytes() const { return written_ + buffer_.size(); }

 private:
  static constexpr size_t kBuffer = size_t{1} << 20;

  void flush();
  void write_through(std::string_view bytes);
  [[noreturn]] void fail(const char* what, int reason);

  std::filesystem::path path_, temporary_;
  int descriptor_ = -1;
  std::string buffer_;
  uint64_t written_ = 0;
};

}  // namespace hybridrt
