#include "core/scene/obj_filter.h"

#include <algorithm>
#include <array>
#include <limits>

#include "core/base/error.h"

namespace hybridrt {
namespace {

// Statements that carry nothing we draw, or nothing we read yet. `vt` is counted before.
constexpr std::array<std::string_view, 18> kIgnored = {
    "g",  "o",      "s",      "p",        "l",        "vp",         "lod",       "mg", "bevel",
    "vw", "usemap", "maplib", "c_interp", "d_interp", "shadow_obj", "trace_obj", "t",  "end"};

// What to do about a line that cannot be meant.
constexpr const char* kMend = "mend that line or export the mesh again";

const char* skip_blanks(const char* p, const char* end) {
  while (p != end && is_blank(*p)) ++p;
  return p;
}

const char* word_end(const char* p, const char* end) {
  while (p != end && !is_blank(*p)) ++p;
  return p;
}

/// The end of the decimal number at `p`, or null when what stands there is none (nan, inf, 0x10, 1,5), or
/// is far too large for tinyobjloader's exponent.
const char* scan_number(const char* p, const char* end) {
  if (p != end && (*p == '-' || *p == '+')) ++p;
  const char* start = p;
  while (p != end && is_digit(*p)) ++p;
  ptrdiff_t digits = p - start;
  if (p != end && *p == '.') {
    start = ++p;
    while (p != end && is_digit(*p)) ++p;
    digits += p - start;
  }
  if (digits == 0) return nullptr;
  if (p != end && (*p == 'e' || *p == 'E')) {
    ++p;
    const bool small = p != end && *p == '-';
    if (p != end && (*p == '-' || *p == '+')) ++p;
    start = p;
    while (p != end && *p == '0') ++p;
    const char* significant = p;
    while (p != end && is_digit(*p)) ++p;
    if (p == start || (!small && p - significant > 4)) return nullptr;
  }
  return p == end || is_blank(*p) ? p : nullptr;
}

/// Reads an optionally signed integer; it saturates far outside of what an int holds. Null without digits.
char* scan_index(char* p, const char* end, int64_t& index) {
  const bool negative = p != end && *p == '-';
  if (p != end && (*p == '-' || *p == '+')) ++p;
  char* const start = p;
  int64_t value = 0;
  for (; p != end && is_digit(*p); ++p)
    if (value < int64_t{1} << 50) value = 10 * value + (*p - '0');
  index = negative ? -value : value;
  return p == start ? nullptr : p;
}

}  // namespace

ObjFilter::int_type ObjFilter::underflow() {
  TextLine line;
  while (lines_.next(line)) {
    if (!wanted(line)) continue;
    setg(line.begin, line.begin, line.end + 1);
    return traits_type::to_int_type(*line.begin);
  }
  return traits_type::eof();
}

/// Checks one line; false when tinyobjloader need not see it.
bool ObjFilter::wanted(TextLine& line) {
  char* p = line.begin;
  char* const end = line.end;
  while (p != end && is_blank(*p)) ++p;
  if (p == end || *p == '#') return false;

  char* const word = p;
  while (p != end && !is_blank(*p)) ++p;
  const std::string_view statement(word, p - word);
  if (statement == "v") {
    check_vertex(p, end);
    ++vertices_;
    return true;
  }
  if (statement == "f") {
    check_face(p, end);
    return true;
  }
  if (statement == "vn") {
    ++normals_;
    static char zero[] = "vn 0 0 0\n";
    if (!readable_normal(p, end)) line = {zero, zero + sizeof zero - 2};
    return true;
  }
  if (statement == "vt") {
    ++texcoords_;
    return false;
  }
  if (statement == "usemtl") return p != end;
  if (statement == "mtllib") {
    libraries_.emplace_back(trimmed({p, static_cast<size_t>(end - p)}));
    return false;
  }
  if (std::find(kIgnored.begin(), kIgnored.end(), statement) == kIgnored.end())
    unknown_.add(lines_.line_number());
  return false;
}

void ObjFilter::check_vertex(char* text, const char* end) const {
  const char* p = text;
  for (char axis : {'x', 'y', 'z'}) {
    p = skip_blanks(p, end);
    const char* stop = scan_number(p, end);
    if (stop == nullptr && p == end)
      throw error(ErrorKind::input, "{}:{}: vertex {} ends before its {} coordinate; is the file cut short?",
                  path().string(), line(), vertices_ + 1, axis);
    if (stop == nullptr)
      throw error(ErrorKind::input, "{}:{}: vertex {}: its {} coordinate {} is not a usable number; {}",
                  path().string(), line(), vertices_ + 1, axis, in_quotes({p, size_t(word_end(p, end) - p)}), kMend);
    p = stop;
  }
}

bool ObjFilter::readable_normal(char* text, const char* end) const {
  const char* p = text;
  for (int axis = 0; axis < 3; ++axis) {
    p = scan_number(skip_blanks(p, end), end);
    if (p == nullptr) return false;
  }
  return true;
}

void ObjFilter::check_face(char* p, const char* end) {
  ++faces_;
  size_t corners = 0;
  for (;;) {
    while (p != end && is_blank(*p)) ++p;
    if (p == end) break;
    check_corner(p, end, ++corners);
  }
  if (corners < 3 && lines_.unfinished())
    throw error(ErrorKind::input, "{}:{}: the file ends in the middle of a face; is it cut short?",
                path().string(), line());
  if (corners < 3) small_faces_.add(line());
}

void ObjFilter::check_corner(char*& p, const char* end, size_t corner) {
  char* const start = p;
  int64_t index = 0;
  p = scan_index(p, end, index);
  if (p == nullptr) fail_corner(start, end, corner);

  const auto count = static_cast<int64_t>(vertices_);
  if (index == 0 || index < -count || index > std::numeric_limits<int32_t>::max())
    throw error(ErrorKind::input,
                "{}:{}: face {}, corner {}: there is no vertex {} ({} so far, counted from 1); {}",
                path().string(), line(), faces_, corner, in_quotes({start, size_t(p - start)}), vertices_, kMend);
  if (index > count && index > farthest_.index)
    farthest_ = {static_cast<int32_t>(index), static_cast<uint32_t>(line())};

  for (const bool is_normal : {false, true}) {
    if (p == end || *p != '/') break;
    char* const digits = ++p;
    if (p == end || is_blank(*p) || *p == '/') continue;  // left empty
    p = scan_index(p, end, index);
    if (p == nullptr) fail_corner(start, end, corner);
    if (is_normal)
      check_attribute(digits, p, index, normals_, normals_ahead_, bad_normals_);
    else
      check_attribute(digits, p, index, texcoords_, texcoords_ahead_, bad_texcoords_);
  }
  if (p != end && !is_blank(*p)) fail_corner(start, end, corner);
}

/// A vt or vn index that leads nowhere is left out; one that points ahead is looked at in finish().
void ObjFilter::check_attribute(char* digits, const char* digits_end, int64_t index, size_t count,
                                std::vector<Ahead>& ahead, Tally& bad) {
  if (index > 0 && index <= static_cast<int64_t>(count)) return;
  if (index < 0 && index >= -static_cast<int64_t>(count)) return;
  if (index > 0 && index <= std::numeric_limits<int32_t>::max()) {
    ahead.push_back({static_cast<int32_t>(index), static_cast<uint32_t>(line())});
    return;
  }
  bad.add(line());
  while (digits != digits_end) *digits++ = '0';
}

void ObjFilter::fail_corner(const char* p, const char* end, size_t corner) const {
  const std::string word = in_quotes({p, size_t(word_end(p, end) - p)});
  if (p != end && *p == '/')
    throw error(ErrorKind::input, "{}:{}: face {}, corner {}: {} has no vertex index; {}", path().string(),
                line(), faces_, corner, word, kMend);
  throw error(ErrorKind::input, "{}:{}: face {}, corner {}: {} is not of the form v, v/vt, v//vn or v/vt/vn; {}",
              path().string(), line(), faces_, corner, word, kMend);
}

void ObjFilter::finish(Warnings& warnings) {
  if (farthest_.index > static_cast<int64_t>(vertices_))
    throw error(ErrorKind::input, "{}:{}: a face uses vertex {}, but the file has {} vertices; is it cut short?",
                path().string(), farthest_.line, farthest_.index, vertices_);
  for (const Ahead& ahead : texcoords_ahead_)
    if (ahead.index > static_cast<int64_t>(texcoords_)) bad_texcoords_.add(ahead.line);
  for (const Ahead& ahead : normals_ahead_)
    if (ahead.index > static_cast<int64_t>(normals_)) bad_normals_.add(ahead.line);
  texcoords_ahead_ = {}, normals_ahead_ = {};

  report(small_faces_, "faces of fewer than three corners were left out", path(), warnings);
  report(bad_texcoords_, "texture coordinate indices lead nowhere and were left out", path(), warnings);
  report(bad_normals_, "normal indices lead nowhere and were left out", path(), warnings);
  report(unknown_, "lines of an unknown kind were left out", path(), warnings);
}

}  // namespace hybridrt
