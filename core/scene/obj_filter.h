#pragma once

#include <cstdint>
#include <streambuf>
#include <string>
#include <vector>

#include "core/base/warnings.h"
#include "core/scene/text_lines.h"
#include "core/scene/text_scan.h"

namespace hybridrt {

/// An OBJ file as tinyobjloader may see it: line by line, only `v`, `vn`, `f` and `usemtl`, each checked
/// for what tinyobjloader would swallow in silence (a number that is not one reads as 0 there, an index of
/// 2^32 + 1 as 1, a face without a vertex index as vertex 0). So after this filter:
///  - `v` has three well-formed decimal numbers; their size is left to the caller;
///  - `vn` that cannot be read has become 0 0 0, which the caller rebuilds;
///  - `f` has corners v, v/vt, v//vn or v/vt/vn of indices that fit an int; v is not 0 and not before the
///    first vertex; a vt or vn of 0 or before the start has been blanked to 0, which means none.
/// Indices past the end are allowed until finish(), since vertices may follow the faces that use them.
///
/// Lines are served one at a time, so that line() is the line being parsed while a callback runs.
/// Throws Error (input) naming file and line, from underflow() too: the istream over this buffer needs
/// exceptions(std::ios::badbit), or it swallows them.
class ObjFilter : public std::streambuf {
 public:
  explicit ObjFilter(const std::filesystem::path& path) : lines_(path, LineJoin::obj) {}

  size_t line() const { return lines_.line_number(); }
  const std::filesystem::path& path() const { return lines_.path(); }

  /// What follows `mtllib`, one entry a line, untouched (file names may hold blanks).
  const std::vector<std::string>& libraries() const { return libraries_; }
  size_t faces() const { return faces_; }

  /// Call once after the last line: checks the indices that pointed ahead (throws), and says what was
  /// left out.
  void finish(Warnings& warnings);

 protected:
  int_type underflow() override;

 private:
  struct Ahead {
    int32_t index;
    uint32_t line;
  };

  bool wanted(TextLine& line);
  void check_vertex(char* p, const char* end) const;
  bool readable_normal(char* p, const char* end) const;
  void check_face(char* p, const char* end);
  void check_corner(char*& p, const char* end, size_t corner);
  void check_attribute(char* digits, const char* digits_end, int64_t index, size_t count,
                       std::vector<Ahead>& ahead, Tally& bad);
  [[noreturn]] void fail_corner(const char* p, const char* end, size_t corner) const;

  TextLines lines_;
  std::vector<std::string> libraries_;
  size_t vertices_ = 0, texcoords_ = 0, normals_ = 0, faces_ = 0;
  Ahead farthest_{0, 0};  // the largest position index that pointed ahead
  std::vector<Ahead> texcoords_ahead_, normals_ahead_;
  Tally bad_texcoords_, bad_normals_, small_faces_, unknown_;
};

}  // namespace hybridrt
