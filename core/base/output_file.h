#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <utility>

namespace hybridrt {

/// A file that appears under its final name only when it is whole: a hidden temporary beside it
/// (`.NAME.tmp-PID-N`), fsync, rename. Whoever looks at the final name, at any moment and after a crash, finds
/// the old file, none, or the new one complete. Missing folders are created, a symbolic link is followed, not
/// replaced; a device or pipe (/dev/null) has no whole to protect and is written straight. Without
/// commit(), nothing is left behind (a killed process may leave the temporary).
///
/// Every function throws Error (output), naming the file and the system's reason. Under a file size limit the
/// process must ignore SIGXFSZ for that. Several may be open for the same path, in any thread; the last one
/// to commit wins. One object belongs to one thread at a time.
class OutputFile {
 public:
  explicit OutputFile(const std::filesystem::path& path);
  /// Standard output as it is, whatever it is: appended to and never replaced, though it be a file.
  static OutputFile standard_output();
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
  /// Makes what was written so far appear, whole, and goes on; costs a copy of it. Devices and pipes: nothing.
  void checkpoint();
  uint64_t bytes() const { return written_ + buffer_.size(); }

 private:
  OutputFile(std::string name, int descriptor) : path_(std::move(name)), descriptor_(descriptor) {}
  static constexpr size_t kBuffer = size_t{1} << 20;

  void flush();
  void write_through(std::string_view bytes);
  void sync_folder();
  [[noreturn]] void fail(const char* step, int reason) const;

  const std::filesystem::path path_;          ///< as the caller named it
  std::filesystem::path target_, temporary_;  ///< no temporary: `target_` is written straight
  int descriptor_ = -1;
  std::string buffer_;
  uint64_t written_ = 0;
};

/// Throws what OutputFile would; leaves nothing but the folder. Devices and pipes are not tried.
void require_writable(const std::filesystem::path& path);

/// The whole file at once.
void write_file_atomically(const std::filesystem::path& path, std::span<const std::byte> bytes);
void write_file_atomically(const std::filesystem::path& path, std::string_view text);

}  // namespace hybridrt
