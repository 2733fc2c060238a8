#pragma once

#include <filesystem>
#include <string>

#include "core/render/output_pattern.h"

namespace hybridrt::cli {

/// The two tables of a render.
struct TableNames {
  std::filesystem::path timings, report;
};

/// `timings.csv` and `run.json` in `folder`; of a part of a sequence `timings.PART.csv` and `run.PART.json`
/// (name_part_of()). Where the report of another render is there already, this render's are `STEM.timings.csv` and
/// `STEM.run.json`.
TableNames table_names(const std::filesystem::path& folder, const std::string& part, const OutputPattern& pattern);

}  // namespace hybridrt::cli
