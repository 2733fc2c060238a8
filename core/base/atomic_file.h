#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <string_view>

namespace hybridrt {

/// Writes the whole file or nothing: a hidden temporary beside it (`.NAME.tmp-PID-N`), fsync, rename. Whoever
/// looks at `path`, at any moment and after a crash, finds the old file, none, or the new one complete. A
/// symbolic link is followed, not replaced; a device or pipe (/dev/stdout) has no whole to protect and is
/// written straight. The folder must exist. Thread-safe, also for the same path: the last one wins.
/// Throws Error output naming `path` and the system's reason; the temporary is gone then. Under a file size
/// limit the process must ignore SIGXFSZ for this to be an Error.
void write_file_atomically(const std::filesystem::path& path, std::span<const std::byte> bytes);
void write_file_atomically(const std::filesystem::path& path, std::string_view text);

}  // namespace hybridrt
