#include "core/scene/text_lines.h"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <string_view>

#include "core/base/error.h"

namespace hybridrt {
namespace {

constexpr size_t kBlock = size_t{1} << 20;

char* find_line_end(char* begin, char* end, bool has_cr) {
  if (!has_cr) return static_cast<char*>(std::memchr(begin, '\n', end - begin));
  for (char* p = begin; p != end; ++p)
    if (*p == '\n' || *p == '\r') return p;
  return nullptr;
}

/// Whether the line goes on in the next one.
bool continues(const TextLine& line) {
  if (line.begin == line.end || line.end[-1] != '\\') return false;
  const std::string_view text(line.begin, line.end - line.begin);
  const std::string_view statement = text.substr(std::min(text.find_first_not_of(" \t"), text.size()));
  return !(statement.starts_with('#') || statement.starts_with("o ") || statement.starts_with("g ") ||
           statement.starts_with("usemtl"));
}

}  // namespace

TextLines::TextLines(const std::filesystem::path& path, LineJoin join)
    : path_(path), join_(join), file_(nullptr, &std::fclose) {
  std::error_code ignored;
  if (std::filesystem::is_directory(path, ignored))
    throw error(ErrorKind::input, "{} is a directory; name the file in it", path.string());
  file_.reset(std::fopen(path.c_str(), "rb"));
  if (!file_) throw error(ErrorKind::input, "{} cannot be opened: {}; check its name and permissions",
                          path.string(), std::strerror(errno));
  std::setvbuf(file_.get(), nullptr, _IONBF, 0);  // we read whole blocks
}

bool TextLines::next(TextLine& line) {
  if (!next_part(line)) return false;
  line_number_ = parts_;
  if (join_ == LineJoin::none || !continues(line)) return true;

  joined_.clear();
  for (;;) {
    const bool more = continues(line);
    joined_.append(line.begin, line.end - (more ? 1 : 0));
    if (joined_.size() > kLongestLine)
      throw error(ErrorKind::input, "{}:{}: a line longer than {} MiB; is this an OBJ file?", path_.string(),
                  line_number_, kLongestLine >> 20);
    if (!more) break;
    joined_ += ' ';
    if (!next_part(line)) break;
  }
  joined_ += '\n';
  line = {joined_.data(), joined_.data() + joined_.size() - 1};
  return true;
}

bool TextLines::next_part(TextLine& part) {
  size_t searched = 0;
  for (;;) {
    if (skip_newline_ && begin_ < end_) {
      if (buffer_[begin_] == '\n') ++begin_;
      skip_newline_ = false;
    }
    char* const begin = buffer_.data() + begin_;
    char* const end = buffer_.data() + end_;
    if (char* stop = searched < end_ - begin_ ? find_line_end(begin + searched, end, has_cr_) : nullptr) {
      skip_newline_ = *stop == '\r';
      *stop = '\n';
      part = {begin, stop};
      begin_ = stop + 1 - buffer_.data();
      ++parts_;
      return true;
    }
    searched = end_ - begin_;
    if (searched > kLongestLine)
      throw error(ErrorKind::input, "{}:{}: a line longer than {} MiB; is this a text file?", path_.string(),
                  parts_ + 1, kLongestLine >> 20);
    if (refill()) continue;
    if (searched == 0) return false;
    part = {buffer_.data() + begin_, buffer_.data() + end_};  // a last line without an end
    *part.end = '\n';
    begin_ = end_;
    unfinished_ = true;
    ++parts_;
    return true;
  }
}

/// Moves what is unread to the front and reads one block behind it; false when the file has no more.
bool TextLines::refill() {
  if (begin_ > 0) std::memmove(buffer_.data(), buffer_.data() + begin_, end_ - begin_);
  end_ -= begin_;
  begin_ = 0;
  if (buffer_.size() < end_ + kBlock + 1) buffer_.resize(2 * end_ + kBlock + 1);
  const size_t from = end_;
  end_ += std::fread(buffer_.data() + end_, 1, kBlock, file_.get());
  if (std::ferror(file_.get()))
    throw error(ErrorKind::input, "{} cannot be read: {}", path_.string(), std::strerror(errno));
  if (end_ == from) return false;
  check_new_bytes(from);
  return true;
}

void TextLines::check_new_bytes(size_t from) {
  char* const begin = buffer_.data() + from;
  char* const end = buffer_.data() + end_;
  if (first_block_) {
    first_block_ = false;
    const std::string_view start(begin, end - begin);
    if (start.starts_with("\xFF\xFE") || start.starts_with("\xFE\xFF"))
      throw error(ErrorKind::input, "{}:1: the text is UTF-16; save it as UTF-8", path_.string());
    if (start.starts_with("\xEF\xBB\xBF")) begin_ += 3;
  }
  has_cr_ = has_cr_ || std::memchr(begin, '\r', end - begin);
  if (void* nul = std::memchr(begin, '\0', end - begin)) {
    const size_t line = 1 + parts_ + std::count(buffer_.data() + begin_, static_cast<char*>(nul), '\n');
    throw error(ErrorKind::input,
                "{}:{}: a NUL byte: this is a binary file or UTF-16; save it as UTF-8 text",
                path_.string(), line);
  }
}

}  // namespace hybridrt
