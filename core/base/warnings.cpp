#include "core/base/warnings.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace hybridrt {

std::string in_quotes(std::string_view text) {
  std::string result = "'";
  for (char c : text.substr(0, 60)) result += static_cast<unsigned char>(c) < 32 || c == 127 ? '?' : c;
  return result + (text.size() > 60 ? "…'" : "'");
}

void NameList::add(std::string_view name) {
  constexpr size_t kMostSpelledOut = 12;
  if (known_.emplace(name).second && first_.size() < kMostSpelledOut) first_.push_back(in_quotes(name));
}

std::string NameList::text() const {
  const size_t more = known_.size() - first_.size();
  return fmt::format("{}", fmt::join(first_, ", ")) + (more > 0 ? fmt::format(" and {} more", more) : std::string());
}

void report(const Tally& tally, std::string_view what, const std::filesystem::path& file, Warnings& warnings,
            std::string_view place) {
  if (tally.count > 0)
    warnings.push_back(fmt::format("{}: {} {} (first at {} {})", file.filename().string(), tally.count, what, place,
                                   tally.first_line));
}

}  // namespace hybridrt
