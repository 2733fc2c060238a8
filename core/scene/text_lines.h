#pragma once

#include <cstddef>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

namespace hybridrt {

/// One logical line without its end: the bytes [begin, end). `*end` is a newline. The bytes belong to the
/// reader, may be overwritten, and live until the next line is read.
struct TextLine {
  char* begin = nullptr;
  char* end = nullptr;
};

enum class LineJoin {
  none,
  obj,  ///< a line that ends in a backslash goes on in the next one, except comments and names (o, g,
        ///< usemtl): those end in a backslash by accident (Windows paths), and would swallow a vertex
};

/// Reads OBJ and MTL text in blocks, memory bounded by the longest line allowed. Ends of line may be LF,
/// CRLF or a lone CR; a UTF-8 byte-order mark is dropped; the last line needs no end.
///
/// Throws Error (input), naming file and line, for a file that cannot be opened or read, a directory,
/// UTF-16, a NUL byte, and a line longer than kLongestLine.
class TextLines {
 public:
  /// 8 MiB: a face of 300,000 corners written as v/vt/vn with nine digits each still passes.
  static constexpr size_t kLongestLine = size_t{8} << 20;

  TextLines(const std::filesystem::path& path, LineJoin join);

  /// False at the end of the file.
  bool next(TextLine& line);

  /// Of the line that next() gave last (of its first part when it was joined), counted from 1.
  size_t line_number() const { return line_number_; }
  /// Whether the file ended before that line did: a last line like that may be a torso.
  bool unfinished() const { return unfinished_; }
  const std::filesystem::path& path() const { return path_; }

 private:
  bool next_part(TextLine& part);
  bool refill();
  void check_new_bytes(size_t from);

  std::filesystem::path path_;
  LineJoin join_;
  std::unique_ptr<std::FILE, int (*)(std::FILE*)> file_;
  std::vector<char> buffer_;  // unread bytes are [begin_, end_); one byte is kept free behind them
  size_t begin_ = 0, end_ = 0;
  bool first_block_ = true;
  bool has_cr_ = false;        // no carriage return so far: line ends are found by memchr
  bool skip_newline_ = false;  // the last line ended in CR: a newline right behind belongs to it
  bool unfinished_ = false;
  size_t parts_ = 0, line_number_ = 0;
  std::string joined_;
};

}  // namespace hybridrt
