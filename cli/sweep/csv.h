#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace hybridrt::cli {

/// A table of text, as RFC 4180 writes it.
struct CsvTable {
  std::vector<std::string> header;
  std::vector<std::vector<std::string>> rows;  ///< each as long as the header

  std::optional<size_t> column(std::string_view name) const;
};

/// One line with its end. Cells that hold commas, quotes or line breaks are quoted.
std::string csv_line(const std::vector<std::string>& cells);

/// Throws Error(input), naming file and line, for what is no table or has rows of another length than its header.
CsvTable read_csv(const std::filesystem::path& path);

}  // namespace hybridrt::cli
