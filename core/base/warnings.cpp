#include "core/base/warnings.h"

#include <algorithm>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include "core/base/error.h"

namespace hybridrt {

std::string in_quotes(std::string_view text) {
  size_t end = std::min<size_t>(text.size(), 60);
  while (end < text.size() && (static_cast<unsigned char>(text[end]) & 0xC0u) == 0x80u && end > 56)
    --end;  // between characters
  return fmt::format("'{}{}'", in_one_line(text.substr(0, end)), text.size() > end ? "…" : "");
}

void NameList::add(std::string_view name) {
  constexpr size_t kMostSpelledOut = 12;
  if (known_.emplace(name).second && first_.size() < kMostSpelledOut) first_.push_back(in_quotes(name));
}

std::string NameList::text() const {
  const size_t more = known_.size() - first_.size();
  return fmt::format("{}", fmt::join(first_, ", ")) + (more > 0 ? fmt::format(" and {} more", more) : std::string());
}

void report(WarningCode code, const Tally& tally, std::string_view what, const std::filesystem::path& file,
            Warnings& warnings, std::string_view place) {
  if (tally.count > 0)
    warnings.emplace_back(code, fmt::format("{}: {} {} (first at {} {})", file.filename().string(), tally.count, what,
                                            place, tally.first_line));
}

}  // namespace hybridrt
