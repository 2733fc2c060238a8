#include "cli/sweep/csv.h"

#include <algorithm>
#include <fstream>
#include <iterator>

#include "core/base/error.h"
#include "core/base/input_file.h"

namespace hybridrt::cli {
namespace {

std::string quoted(const std::string& cell) {
  if (cell.find_first_of(",\"\r\n") == cell.npos) return cell;
  std::string out = "\"";
  for (char c : cell) {
    if (c == '"') out += c;
    out += c;
  }
  out += '"';
  return out;
}

/// Takes one record off `text`, from `at`.
std::vector<std::string> take_record(const std::string& text, size_t& at) {
  std::vector<std::string> cells(1);
  bool inside = false;
  for (; at < text.size(); ++at) {
    const char c = text[at];
    if (inside && c == '"' && at + 1 < text.size() && text[at + 1] == '"')
      cells.back() += text[++at];
    else if (c == '"')
      inside = !inside;
    else if (!inside && c == ',')
      cells.emplace_back();
    else if (!inside && c == '\n')
      break;
    else if (inside || c != '\r')
      cells.back() += c;
  }
  ++at;
  return cells;
}

}  // namespace

std::optional<size_t> CsvTable::column(std::string_view name) const {
  const auto found = std::find(header.begin(), header.end(), name);
  if (found == header.end()) return std::nullopt;
  return static_cast<size_t>(found - header.begin());
}

std::string csv_line(const std::vector<std::string>& cells) {
  std::string line;
  for (const std::string& cell : cells) {
    line += quoted(cell);
    line += ',';
  }
  line.back() = '\n';
  return line;
}

CsvTable read_csv(const std::filesystem::path& path) {
  require_regular_file(path);
  std::ifstream file(path, std::ios::binary);
  if (!file) throw error(ErrorKind::input, "{}: cannot be read; check the path", path.string());
  const std::string text((std::istreambuf_iterator<char>(file)), {});
  CsvTable table;
  size_t at = 0;
  if (text.empty()) throw error(ErrorKind::input, "{}: is empty; it should have a header row", path.string());
  table.header = take_record(text, at);
  while (at < text.size()) {
    table.rows.push_back(take_record(text, at));
    if (table.rows.back().size() != table.header.size())
      throw error(ErrorKind::input,
                  "{}: row {} has {} cells, the header {}; restore the file or begin in another folder", path.string(),
                  table.rows.size(), table.rows.back().size(), table.header.size());
  }
  return table;
}

}  // namespace hybridrt::cli
