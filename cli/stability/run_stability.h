#pragma once

#include <filesystem>

#include "cli/stability/failure_sweep.h"

namespace hybridrt::cli {

/// A contender fails where more than this share of the pixels is off, or any holds no number.
inline constexpr double kMostBad_percent = 1;

/// Drives each sweep to where its contenders fail and writes into `folder`, each file whole or not at all:
/// stability.csv, a row for each point; thresholds.csv, a row for each contender; stability.json, what was tried and
/// where; pictures of the points where a contender starts to fail. Returns false if a signal stopped it: then the files
/// hold the sweeps that were finished. Throws Error(output).
bool run_stability(const std::vector<FailureSweep>& sweeps, const RenderOptions& base,
                   const std::vector<std::string>& command_line, const std::filesystem::path& folder, bool quiet);

}  // namespace hybridrt::cli
