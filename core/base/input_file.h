#pragma once

#include <chrono>
#include <filesystem>
#include <string>

namespace hybridrt {

/// How long a pipe that is read may bring nothing.
constexpr std::chrono::seconds kLongestSilence{300};

/// Throws Error(input) for a folder, and for a pipe, socket or device, which might be waited for forever or never end.
/// Passes a file that is not there: its reader says so.
void require_regular_file(const std::filesystem::path& path);

/// Up to `most_bytes` + 1 bytes of a file, or of a descriptor that the caller gave (/dev/fd/N, as the shell's <(...)),
/// which may be a pipe. Throws Error(input) as above, for what cannot be opened or read, and for a pipe that brings
/// nothing for `longest_silence`.
std::string read_whole_file(const std::filesystem::path& path, size_t most_bytes,
                            std::chrono::milliseconds longest_silence = kLongestSilence);

/// As read(2), but throws Error(input), naming `what`, when it fails or nothing comes for so long.
size_t read_some(int descriptor, char* to, size_t most_bytes, const std::string& what,
                 std::chrono::milliseconds longest_silence = kLongestSilence);

}  // namespace hybridrt
