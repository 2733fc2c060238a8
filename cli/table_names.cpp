#include "cli/table_names.h"

#include <fmt/format.h>
#include <fstream>
#include <nlohmann/json.hpp>
#include <optional>

namespace hybridrt::cli {
namespace {

namespace fs = std::filesystem;

/// The pattern of the pictures that a run.json is about; nothing if it is no run.json of ours, or an old one.
std::optional<std::string> pattern_in_report(const fs::path& report) {
  std::error_code missing;
  if (!fs::is_regular_file(report, missing)) return std::nullopt;
  std::ifstream file(report);
  const nlohmann::json read = nlohmann::json::parse(file, nullptr, /*allow_exceptions=*/false);
  const auto pattern = nlohmann::json::json_pointer("/outputs/pattern");
  if (!read.is_object() || !read.contains(pattern) || !read[pattern].is_string()) return std::nullopt;
  return read[pattern].get<std::string>();
}

}  // namespace

TableNames table_names(const fs::path& folder, const std::string& part, const OutputPattern& pattern) {
  const std::string end = part.empty() ? "" : "." + part;
  const TableNames usual{folder / ("timings" + end + ".csv"), folder / ("run" + end + ".json")};
  if (!fs::exists(usual.report) || pattern_in_report(usual.report) == pattern.folder + pattern.name) return usual;
  const std::string stem = stem_of(pattern);
  return {folder / fmt::format("{}.timings{}.csv", stem, end), folder / fmt::format("{}.run{}.json", stem, end)};
}

}  // namespace hybridrt::cli
