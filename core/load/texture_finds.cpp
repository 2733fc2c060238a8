#include "core/load/texture_finds.h"

#include <fmt/format.h>

namespace hybridrt {

const std::filesystem::path& TextureFinds::find(std::string_view name, size_t line, bool is_read) {
  const FoundFile& file = files_.find(name);
  if (file.path.empty()) {
    if (missing_.count() == 0) first_missing_line_ = line;
    missing_.add(name);
  } else if (is_read && file.regular && !file.as_written) {
    if (moved_.count() == 0) first_moved_to_ = file.path.string();
    moved_.add(name);
  }
  return file.path;
}

void TextureFinds::report(const std::filesystem::path& named_in, Warnings& warnings) const {
  hybridrt::report(WarningCode::texture_missing, Tally{missing_.count(), first_missing_line_},
                   fmt::format("texture files are missing ({})", missing_.text()), named_in, warnings);
  if (moved_.count() > 0)
    warnings.emplace_back(WarningCode::texture_moved,
                          fmt::format("{}: {} texture names lead to no file as written; found by case, decoding or "
                                      "their last part ({}; first as {})",
                                      named_in.filename().string(), moved_.count(), moved_.text(), first_moved_to_));
}

}  // namespace hybridrt
