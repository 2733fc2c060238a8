#pragma once

#include <filesystem>

#include "cli/exit_codes.h"

namespace hybridrt::cli {

/// Draws the charts and the report of a sweep's folder by the script that is installed with the program; it runs in
/// Python with Matplotlib and lists the files unless `quiet`. Returns the script's exit code: input where they are
/// missing, which it says in one line.
ExitCode draw_charts(const std::filesystem::path& folder, bool quiet = false);

}  // namespace hybridrt::cli
