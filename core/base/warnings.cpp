#include "core/base/warnings.h"

#include <fmt/format.h>

namespace hybridrt {

std::string in_quotes(std::string_view text) {
  std::string result = "'";
  for (char c : text.substr(0, 60)) result += static_cast<unsigned char>(c) < 32 || c == 127 ? '?' : c;
  return result + (text.size() > 60 ? "…'" : "'");
}

void report(const Tally& tally, std::string_view what, const std::filesystem::path& file, Warnings& warnings,
            std::string_view place) {
  if (tally.count > 0)
    warnings.push_back(fmt::format("{}: {} {} (first at {} {})", file.filename().string(), tally.count, what, place,
                                   tally.first_line));
}

}  // namespace hybridrt
