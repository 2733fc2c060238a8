#pragma once

#include <cstddef>
#include <string>
#include <string_view>

#include "core/load/text_blocks.h"

namespace hybridrt {

/// The lines of a text of whole lines (TextBlocks), without their ends, joined where they continue. A line is valid
/// until the next one is read.
///
/// Throws Error (input), naming file and line, for a NUL byte and a line longer than kLongestLine.
class LineScanner {
 public:
  /// `lines_before` is how many lines of `path` come before the text.
  LineScanner(const std::filesystem::path& path, LineJoin join, std::string_view text, size_t lines_before);

  /// False at the end of the text.
  bool next(std::string_view& line);

  /// The number of the line that next() gave last (of its first part if it was joined), counted from 1.
  size_t line_number() const { return line_number_; }
  /// Lines read so far, counting each part of joined ones, and those before the text.
  size_t lines() const { return parts_; }
  /// Whether that line had no end: then the file may be cut short.
  bool unfinished() const { return unfinished_; }

 private:
  bool next_part(std::string_view& part);

  const std::filesystem::path* path_;
  LineJoin join_;
  std::string_view rest_;
  const char* nul_;  // the first NUL byte, or the end
  bool has_cr_;      // else line ends are found by memchr
  bool unfinished_ = false;
  size_t parts_, line_number_ = 0;
  std::string joined_;
};

/// Reads text line by line, memory bounded by the longest line allowed. Throws what TextBlocks and LineScanner throw.
class TextLines {
 public:
  TextLines(const std::filesystem::path& path, LineJoin join);

  /// False at the end of the file.
  bool next(std::string_view& line);

  size_t line_number() const { return scanner_.line_number(); }
  const std::filesystem::path& path() const { return blocks_.path(); }

 private:
  LineJoin join_;
  TextBlocks blocks_;
  LineScanner scanner_;
};

}  // namespace hybridrt
