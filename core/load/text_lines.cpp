#include "core/load/text_lines.h"

#include <algorithm>
#include <cstring>

#include "core/base/error.h"

namespace hybridrt {
namespace {

constexpr size_t kBlock = size_t{1} << 20;

/// The first such byte, or the end.
const char* find_byte(std::string_view text, char byte) {
  const void* found = text.empty() ? nullptr : std::memchr(text.data(), byte, text.size());
  return found ? static_cast<const char*>(found) : text.data() + text.size();
}

}  // namespace

LineScanner::LineScanner(const std::filesystem::path& path, LineJoin join, std::string_view text, size_t lines_before)
    : path_(&path),
      join_(join),
      rest_(text),
      nul_(find_byte(text, '\0')),
      has_cr_(find_byte(text, '\r') != text.data() + text.size()),
      parts_(lines_before) {}

bool LineScanner::next(std::string_view& line) {
  if (!next_part(line)) return false;
  line_number_ = parts_;
  if (join_ == LineJoin::none || !continues(line)) return true;

  joined_.clear();
  for (;;) {
    const bool more = continues(line);
    joined_.append(line.substr(0, line.size() - (more ? 1 : 0)));
    if (joined_.size() > kLongestLine)
      throw error(ErrorKind::input, "{}:{}: a line longer than {} MiB; is this an OBJ file?", path_->string(),
                  line_number_, kLongestLine >> 20);
    if (!more) break;
    joined_ += ' ';
    if (!next_part(line)) break;
  }
  line = joined_;
  return true;
}

bool LineScanner::next_part(std::string_view& part) {
  if (rest_.empty()) return false;
  ++parts_;
  const size_t stop = has_cr_ ? std::min(rest_.find_first_of("\r\n"), rest_.size())
                              : static_cast<size_t>(find_byte(rest_, '\n') - rest_.data());
  part = rest_.substr(0, stop);
  unfinished_ = stop == rest_.size();
  rest_.remove_prefix(std::min(rest_.size(), stop + (rest_.substr(stop).starts_with("\r\n") ? 2 : 1)));
  if (part.size() > kLongestLine)
    throw error(ErrorKind::input, "{}:{}: a line longer than {} MiB; is this a text file?", path_->string(), parts_,
                kLongestLine >> 20);
  if (nul_ < part.data() + part.size())
    throw error(ErrorKind::input, "{}:{}: a NUL byte: this is a binary file or UTF-16; save it as UTF-8 text",
                path_->string(), parts_);
  return true;
}

TextLines::TextLines(const std::filesystem::path& path, LineJoin join)
    : join_(join), blocks_(path, join), scanner_(blocks_.path(), join, {}, 0) {}

bool TextLines::next(std::string_view& line) {
  while (!scanner_.next(line)) {
    const std::string_view block = blocks_.next(kBlock);
    if (block.empty()) return false;
    scanner_ = LineScanner(blocks_.path(), join_, block, scanner_.lines());
  }
  return true;
}

}  // namespace hybridrt
