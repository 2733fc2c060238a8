#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "core/base/temporary_names.h"

namespace hybridrt {

/// Stands in the names of temporary files between the name and the process.
inline constexpr std::string_view kTemporaryMark = ".tmp-";

/// A file that is written atomically: to a hidden temporary beside it (`.NAME.tmp-PID-N`), then fsync, then rename. A
/// reader of the final name finds the old file, none, or the complete new one, at any moment and after a crash. Missing
/// folders are created. A symbolic link is followed, not replaced. A device or pipe (/dev/null) is written directly,
/// and so is a descriptor that the caller gave (/dev/stdout, /dev/fd/3): appended to, never replaced, even where it is
/// a file. Without commit(), nothing is left behind (a killed process may leave the temporary).
///
/// A named pipe must get a reader within ten seconds. Once a signal has asked to stop (interrupt.h), one whose reader
/// takes nothing for a second is given up.
///
/// Every function throws Error (output), naming the file and the system's reason. For that the process must ignore
/// SIGXFSZ if file sizes are limited. Several may be open for the same path, in any thread; the last one to commit
/// wins. One object belongs to one thread at a time.
class OutputFile {
 public:
  explicit OutputFile(const std::filesystem::path& path);
  /// As /dev/stdout, also where there is no such name.
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
  /// Hands what is buffered to the system.
  void flush();
  /// Makes the file appear.
  void commit();
  /// Publishes what was written so far and `more`, atomically, and goes on without `more`; costs a copy of it. Does
  /// nothing for devices and pipes.
  void checkpoint(std::string_view more = {});
  uint64_t bytes() const { return written_ + buffer_.size(); }

 private:
  explicit OutputFile(int descriptor);
  static constexpr size_t kBuffer = size_t{1} << 20;

  void write_to(int descriptor);
  void write_through(std::string_view bytes);
  void sync_folder();
  [[noreturn]] void fail(const char* step, int reason) const;

  const std::filesystem::path path_;  ///< as the caller named it
  /// Without a temporary the target is written directly; without a target a given descriptor is.
  std::filesystem::path target_, temporary_;
  std::optional<TemporaryName> kept_name_;
  int descriptor_ = -1;
  std::string buffer_;
  uint64_t written_ = 0;
};

/// Throws what OutputFile would throw; leaves nothing behind but the folder. Does not try devices and pipes.
void require_writable(const std::filesystem::path& path);

/// Writes the whole file as OutputFile does.
void write_file_atomically(const std::filesystem::path& path, std::span<const std::byte> bytes);
void write_file_atomically(const std::filesystem::path& path, std::string_view text);

}  // namespace hybridrt
