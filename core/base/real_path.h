#pragma once

#include <filesystem>

namespace hybridrt {

/// The absolute path without links, "." and "..", of a file that need not exist: also at the end of a symbolic link
/// that leads nowhere yet. `path` itself where it cannot be told.
std::filesystem::path real_path(const std::filesystem::path& path);

}  // namespace hybridrt
