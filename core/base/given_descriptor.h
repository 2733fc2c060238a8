#pragma once

#include <filesystem>
#include <optional>

namespace hybridrt {

/// The descriptor that `path` stands for: 1 for /dev/stdout, N for /dev/fd/N and /proc/self/fd/N, also through symbolic
/// links. Such a name must be written by the descriptor: its file is the shell's to position, append to and keep, and a
/// socket cannot be opened by name. Nothing for all other paths. The descriptor need not be open.
std::optional<int> descriptor_named_by(const std::filesystem::path& path);

/// Whether the caller of the program gave it this descriptor: those that we open ourselves are closed on exec.
bool is_given(int descriptor);

}  // namespace hybridrt
