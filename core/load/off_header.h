#pragma once

#include <string_view>
#include <vector>

#include "core/load/mesh_builder.h"
#include "core/load/text_lines.h"

namespace hybridrt {

/// The words of an OFF file, line by line or one after the other, without comments and blank lines.
class OffLines {
 public:
  OffLines(const std::filesystem::path& path, const MeshBuilder& mesh) : lines_(path, LineJoin::none), mesh_(mesh) {}

  /// Goes on to the next line that says something. Throws Error (input) at the end of the file.
  void next(const char* expected);
  /// From now on line ends are blanks: words go on in the next line.
  void ignore_line_ends() { ignores_line_ends_ = true; }

  bool done() const { return trimmed(rest_).empty(); }
  size_t words_left() const;
  size_t place() const { return lines_.line_number(); }

  std::string_view word();
  std::string_view peek() const;
  /// Puts the end of the last word back.
  void put_back(std::string_view end_of_word);

  /// Throws Error (input) for a word that is no number.
  double number();
  /// The same, but NaN and infinity are numbers.
  double coordinate();
  /// The same for what is not a whole number up to `most`.
  size_t count(double most);
  size_t as_count(double number, double most) const;

 private:
  TextLines lines_;
  const MeshBuilder& mesh_;
  std::string_view rest_;
  bool ignores_line_ends_ = false;
};

/// What an OFF file holds. After each position come, by the keyword, [ST][C][N][4][n]OFF, normals, colours and texture
/// coordinates.
struct OffHeader {
  bool texture = false, colors = false, normals = false;
  bool homogeneous = false;  ///< a fourth coordinate, by which the others are to be divided
  bool one_line = false;     ///< vertices follow in the line of the counts: `lines` ignores line ends
  bool at_vertex = false;    ///< `lines` is on the line of the first vertex already
  size_t vertices = 0, faces = 0;
};

/// Reads keyword and counts. The keyword may be in lower case, its letters in any order, missing, or glued to the
/// counts; these may be on its line, on their own or on several. Throws Error (input) for what is not OFF, for binary
/// OFF, for other dimensions than three, and for a count above `most`.
OffHeader read_off_header(OffLines& lines, const MeshBuilder& mesh, double most);

}  // namespace hybridrt
