#include "core/load/text_blocks.h"

#include <algorithm>
#include <cerrno>
#include <cstring>

#include "core/base/error.h"
#include "core/base/input_file.h"

namespace hybridrt {
namespace {

/// Whether a line ends before text[at].
bool ends_line(std::string_view text, size_t at, bool more) {
  if (text[at - 1] == '\n') return true;
  return text[at - 1] == '\r' && (at < text.size() ? text[at] != '\n' : !more);
}

/// The last line before text[end], without its end; text[end] must begin a line.
std::string_view line_before(std::string_view text, size_t end) {
  size_t stop = end - 1;
  if (text[stop] == '\n' && stop > 0 && text[stop - 1] == '\r') --stop;
  const size_t before = text.substr(0, stop).find_last_of("\r\n");
  const size_t begin = before == text.npos ? 0 : before + 1;
  return text.substr(begin, stop - begin);
}

}  // namespace

bool continues(std::string_view line) {
  if (line.empty() || line.back() != '\\') return false;
  const std::string_view statement = line.substr(std::min(line.find_first_not_of(" \t"), line.size()));
  return !(statement.starts_with('#') || statement.starts_with("o ") || statement.starts_with("g ") ||
           statement.starts_with("usemtl"));
}

size_t whole_lines(std::string_view text, LineJoin join, bool more) {
  for (size_t end = text.size(); end > 0; --end)
    if (ends_line(text, end, more) && (join == LineJoin::none || !continues(line_before(text, end)))) return end;
  return 0;
}

TextBlocks::TextBlocks(const std::filesystem::path& path, LineJoin join)
    : path_(path), join_(join), file_(nullptr, &std::fclose) {
  require_regular_file(path);
  file_.reset(std::fopen(path.c_str(), "rb"));
  if (!file_)
    throw error(ErrorKind::input, "{} cannot be opened: {}; check its name and permissions", path.string(),
                std::strerror(errno));
  std::setvbuf(file_.get(), nullptr, _IONBF, 0);  // we read whole blocks
  std::error_code ignored;
  const uintmax_t file_bytes = std::filesystem::file_size(path, ignored);
  if (!ignored) most_at_first_ = std::max<uintmax_t>(file_bytes + 1, 4096);
}

std::string_view TextBlocks::next(size_t bytes) {
  for (size_t wanted = std::clamp<size_t>(bytes, 4, most_at_first_);; wanted *= 2) {
    read_up_to(wanted);
    const std::string_view text(buffer_.get() + begin_, end_ - begin_);
    size_t whole = at_end_ ? text.size() : whole_lines(text, join_, true);
    if (whole == 0 && !at_end_) {
      if (text.size() <= 2 * kLongestLine + 2) continue;
      whole = text.size();  // the reader of lines will refuse the first
    }
    begin_ += whole;
    return text.substr(0, whole);
  }
}

/// Moves the unread text to the front and appends to it until it is `bytes` long or the file ends.
void TextBlocks::read_up_to(size_t bytes) {
  const size_t unread = end_ - begin_;
  if (capacity_ < bytes) {
    auto larger = std::make_unique_for_overwrite<char[]>(bytes);
    if (unread > 0) std::memcpy(larger.get(), buffer_.get() + begin_, unread);
    buffer_ = std::move(larger);
    capacity_ = bytes;
  } else if (unread > 0) {
    std::memmove(buffer_.get(), buffer_.get() + begin_, unread);
  }
  begin_ = 0, end_ = unread;
  while (end_ < bytes && !at_end_) {
    const size_t got = std::fread(buffer_.get() + end_, 1, bytes - end_, file_.get());
    if (std::ferror(file_.get()))
      throw error(ErrorKind::input, "{} cannot be read: {}", path_.string(), std::strerror(errno));
    at_end_ = got == 0;
    end_ += got;
    if (first_ && (end_ >= 3 || at_end_)) drop_mark();
  }
}

void TextBlocks::drop_mark() {
  first_ = false;
  const std::string_view start(buffer_.get(), end_);
  if (start.starts_with("\xFF\xFE") || start.starts_with("\xFE\xFF"))
    throw error(ErrorKind::input, "{}:1: the text is UTF-16; save it as UTF-8", path_.string());
  if (start.starts_with("\xEF\xBB\xBF")) begin_ += 3;
}

}  // namespace hybridrt
