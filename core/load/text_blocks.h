#pragma once

#include <cstdio>
#include <filesystem>
#include <limits>
#include <memory>
#include <string>
#include <string_view>

namespace hybridrt {

enum class LineJoin {
  none,
  obj,  ///< a line that ends in a backslash goes on in the next one, except comments and names (o, g,
        ///< usemtl): those end in a backslash by accident (Windows paths), and would swallow a vertex
};

/// No line is longer than this, joined or not: 8 MiB. A face of 300,000 corners written as v/vt/vn with nine digits
/// each still passes.
inline constexpr size_t kLongestLine = size_t{8} << 20;

/// Whether a line, without its end, goes on in the next one.
bool continues(std::string_view line);

/// The length of the whole lines that `text` begins with; joined lines are not cut. `more`: whether other text follows,
/// since a carriage return at the end may be half of a CRLF.
size_t whole_lines(std::string_view text, LineJoin join, bool more);

/// Reads text in blocks of whole lines. Line ends may be LF, CRLF or a lone CR; a UTF-8 byte-order mark is dropped; the
/// last line needs no end. A line that is too long may be cut, but is still longer than kLongestLine.
///
/// Throws Error (input) for a file that cannot be opened or read, a directory, and UTF-16.
class TextBlocks {
 public:
  TextBlocks(const std::filesystem::path& path, LineJoin join);

  /// About `bytes` of text: fewer at the end of the file, more where a line is longer, none when it has all been read.
  /// Valid until the next call.
  std::string_view next(size_t bytes);

  const std::filesystem::path& path() const { return path_; }

 private:
  void read_up_to(size_t bytes);
  void drop_mark();

  std::filesystem::path path_;
  LineJoin join_;
  std::unique_ptr<std::FILE, int (*)(std::FILE*)> file_;
  std::unique_ptr<char[]> buffer_;  // unread bytes are [begin_, end_)
  size_t capacity_ = 0, begin_ = 0, end_ = 0;
  size_t most_at_first_ = std::numeric_limits<size_t>::max();  ///< small files need no large buffers
  bool at_end_ = false, first_ = true;
};

}  // namespace hybridrt
