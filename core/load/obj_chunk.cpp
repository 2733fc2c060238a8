#include "core/load/obj_chunk.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <limits>
#include <unordered_map>

#include "core/base/error.h"
#include "core/base/warnings.h"
#include "core/load/mesh_colors.h"
#include "core/load/text_lines.h"

namespace hybridrt {
namespace {

// Statements with nothing that we draw, or nothing that we read yet.
constexpr std::array<std::string_view, 18> kIgnored = {
    "g",  "o",      "s",      "p",        "l",        "vp",         "lod",       "mg", "bevel",
    "vw", "usemap", "maplib", "c_interp", "d_interp", "shadow_obj", "trace_obj", "t",  "end"};

// What a user can do about a faulty line.
constexpr const char* kFix = "fix that line or export the mesh again";

/// Reads an optionally signed integer, which saturates far beyond the range of int. Null without digits.
const char* scan_index(const char* p, const char* end, int64_t& index) {
  const bool negative = p != end && *p == '-';
  if (p != end && (*p == '-' || *p == '+')) ++p;
  const char* const start = p;
  int64_t value = 0;
  for (; p != end && is_digit(*p); ++p)
    if (value < int64_t{1} << 50) value = 10 * value + (*p - '0');
  index = negative ? -value : value;
  return p == start ? nullptr : p;
}

class ChunkReader {
 public:
  ChunkReader(const std::filesystem::path& path, ObjChunk& chunk)
      : path_(path), chunk_(chunk), lines_(path, LineJoin::obj, chunk.text, chunk.before.lines) {}

  void read() {
    for (std::string_view rest; lines_.next(rest);) {
      const std::string_view statement = take_word(rest);
      if (statement.empty()) continue;
      if (statement.front() == '#') {
        if (statement == "#MRGB") read_polypaint(trimmed(rest));
        continue;
      }
      read_statement(statement, rest);
    }
  }

 private:
  size_t line() const { return lines_.line_number(); }
  size_t vertices() const { return chunk_.before.vertices + chunk_.data.positions.size(); }
  size_t normals() const { return chunk_.before.normals + chunk_.data.normals.size(); }
  size_t texcoords() const { return chunk_.before.texcoords + chunk_.data.texcoords.size(); }
  size_t face() const { return chunk_.before.faces + chunk_.data.faces; }

  template <typename... Args>
  [[noreturn]] void fail(fmt::format_string<Args...> format, Args&&... args) const {
    throw error(ErrorKind::input, "{}:{}: {}", path_.string(), line(),
                fmt::format(format, std::forward<Args>(args)...));
  }

  void read_statement(std::string_view statement, std::string_view rest) {
    if (statement == "v") return read_vertex(rest);
    if (statement == "f") return read_face(rest);
    if (statement == "vn") return read_normal(rest);
    if (statement == "vt") return read_texcoord(rest);
    if (statement == "usemtl") {
      if (!rest.empty()) set_material(trimmed(rest));
    } else if (statement == "mtllib") {
      chunk_.data.libraries.emplace_back(trimmed(rest));
    } else if (std::find(kIgnored.begin(), kIgnored.end(), statement) == kIgnored.end()) {
      chunk_.unknown.add(line());
    }
  }

  void read_vertex(std::string_view rest) {
    dvec3 p;
    for (int axis = 0; axis < 3; ++axis) {
      const std::string_view word = take_word(rest);
      if (word.empty())
        fail("vertex {} ends before its {} coordinate; is the file cut short?", vertices() + 1, "xyz"[axis]);
      const std::optional<double> number = parse_coordinate(word);
      if (!number)
        fail("vertex {}: its {} coordinate {} is not a usable number; {}", vertices() + 1, "xyz"[axis], in_quotes(word),
             kFix);
      p[axis] = *number;
    }
    if (!is_usable(p)) chunk_.bad_vertices.push_back({vertices(), line()});
    chunk_.data.positions.push_back(p);
    if (!trimmed(rest).empty() || !chunk_.data.colors.empty()) read_color(rest);
  }

  /// The colour of the last vertex: three numbers. One alone is a weight, which is not used.
  void read_color(std::string_view rest) {
    dvec3 color;
    int numbers = 0;
    std::string_view word = take_word(rest);
    for (; numbers < 3; ++numbers, word = take_word(rest)) {
      const std::optional<double> number = parse_number(word);
      if (!number) break;
      color[numbers] = *number;
    }
    if (numbers == 2 || (numbers < 2 && !word.empty() && word.front() != '#')) chunk_.bad_colors.add(line());
    std::vector<vec3>& colors = chunk_.data.colors;
    if (numbers < 3 && colors.empty()) return;
    colors.resize(chunk_.data.positions.size() - 1, kNoColor);
    colors.push_back(numbers < 3 ? kNoColor : color_of_numbers(color));
  }

  /// ZBrush's polypaint: eight hexadecimal digits a vertex, mask, red, green, blue.
  void read_polypaint(std::string_view digits) {
    for (; !digits.empty(); digits.remove_prefix(8)) {
      uint32_t color = 0;
      const char* const end = digits.data() + std::min<size_t>(8, digits.size());
      const auto [stop, status] = std::from_chars(digits.data(), end, color, 16);
      if (digits.size() < 8 || stop != end || status != std::errc()) return chunk_.bad_polypaint.add(line());
      chunk_.polypaint.push_back(color);
    }
  }

  void read_normal(std::string_view rest) {
    dvec3 n(0);
    for (int axis = 0; axis < 3; ++axis) {
      const std::optional<double> number = parse_number(take_word(rest));
      if (!number) {
        n = dvec3(0);
        break;
      }
      n[axis] = *number;
    }
    chunk_.data.normals.push_back(usable_normal(n));
  }

  /// One number or two; a third, for volumes, is ignored.
  void read_texcoord(std::string_view rest) {
    constexpr double kLargest = 1e6;  // beyond, a float has too few digits to place a texel
    vec2 texcoord(0);
    for (int axis = 0; axis < 2; ++axis) {
      const std::string_view word = take_word(rest);
      if (axis > 0 && word.empty()) break;
      const std::optional<double> number = parse_number(word);
      if (!number || !(std::abs(*number) <= kLargest)) {
        texcoord = vec2(0);
        chunk_.unread_texcoords.add(line());
        break;
      }
      texcoord[axis] = static_cast<float>(*number);
    }
    chunk_.data.texcoords.push_back(texcoord);
  }

  void set_material(std::string_view name) {
    const auto [entry, is_new] =
        material_ids_.try_emplace(std::string(name), static_cast<uint32_t>(chunk_.data.material_names.size()));
    if (is_new) chunk_.data.material_names.emplace_back(name);
    chunk_.last_material = entry->second;
  }

  void read_face(std::string_view rest) {
    ++chunk_.data.faces;
    corners_.clear();
    const char* p = rest.data();
    const char* const end = p + rest.size();
    for (;;) {
      while (p != end && is_blank(*p)) ++p;
      if (p == end) break;
      p = read_corner(p, end);
    }
    if (corners_.size() < 3) {
      if (lines_.unfinished()) fail("the file ends in the middle of a face; is it cut short?");
      return chunk_.small_faces.add(line());
    }
    if (corners_.size() == 3) return append_triangle(corners_[0], corners_[1], corners_[2]);

    ObjChunk::Polygon polygon{chunk_.data.triangle_positions.size(), chunk_.polygon_corners.size(),
                              static_cast<uint32_t>(corners_.size()), static_cast<uint32_t>(line()), 0};
    for (const ObjChunk::Corner& corner : corners_) polygon.farthest = std::max(polygon.farthest, corner.position);
    chunk_.polygons.push_back(polygon);
    chunk_.polygon_corners.insert(chunk_.polygon_corners.end(), corners_.begin(), corners_.end());
    for (size_t i = 2; i < corners_.size(); ++i) append_triangle(corners_[0], corners_[i - 1], corners_[i]);
  }

  void append_triangle(const ObjChunk::Corner& p, const ObjChunk::Corner& q, const ObjChunk::Corner& r) {
    MeshData& data = chunk_.data;
    append_indices(data.triangle_normals, uvec3(p.normal, q.normal, r.normal));
    append_indices(data.triangle_texcoords, uvec3(p.texcoord, q.texcoord, r.texcoord));
    data.triangle_positions.emplace_back(p.position, q.position, r.position);
    data.triangle_materials.push_back(chunk_.last_material);
    data.triangle_places.push_back(static_cast<uint32_t>(line()));
  }

  /// The array stays empty until the first triangle with an index.
  void append_indices(std::vector<uvec3>& all, const uvec3& indices) const {
    const bool has_some = indices != uvec3(kNoIndex);
    if (has_some && all.empty()) all.resize(chunk_.data.triangle_positions.size(), uvec3(kNoIndex));
    if (has_some || !all.empty()) all.push_back(indices);
  }

  const char* read_corner(const char* p, const char* end) {
    const char* const start = p;
    int64_t index = 0;
    p = scan_index(p, end, index);
    if (p == nullptr) fail_corner(start, end);

    const auto count = static_cast<int64_t>(vertices());
    if (index == 0 || index < -count || index > std::numeric_limits<int32_t>::max())
      fail("face {}, corner {}: there is no vertex {} ({} so far, counted from 1); {}", face(), corners_.size() + 1,
           in_quotes({start, static_cast<size_t>(p - start)}), count, kFix);
    if (index > count && index > chunk_.farthest.index)
      chunk_.farthest = {static_cast<int32_t>(index), static_cast<uint32_t>(line())};
    ObjChunk::Corner corner{resolved(index, vertices()), kNoIndex, kNoIndex};

    for (const bool is_normal : {false, true}) {
      if (p == end || *p != '/') break;
      ++p;
      if (p == end || is_blank(*p) || *p == '/') continue;  // left empty
      p = scan_index(p, end, index);
      if (p == nullptr) fail_corner(start, end);
      if (is_normal)
        corner.normal = checked(index, normals(), chunk_.normals_ahead, chunk_.bad_normals);
      else
        corner.texcoord = checked(index, texcoords(), chunk_.texcoords_ahead, chunk_.bad_texcoords);
    }
    if (p != end && !is_blank(*p)) fail_corner(start, end);
    corners_.push_back(corner);
    return p;
  }

  /// The 0-based form of an index that is 1-based or, counted from the end, negative.
  static uint32_t resolved(int64_t index, size_t count) {
    return static_cast<uint32_t>(index > 0 ? index - 1 : static_cast<int64_t>(count) + index);
  }

  /// A vt or vn index out of range is left out; one that points ahead is checked when all vertices are known.
  uint32_t checked(int64_t index, size_t count, std::vector<ObjChunk::Ahead>& ahead, Tally& bad) {
    const auto signed_count = static_cast<int64_t>(count);
    if (index != 0 && index >= -signed_count && index <= signed_count) return resolved(index, count);
    if (index > 0 && index <= std::numeric_limits<int32_t>::max()) {
      ahead.push_back({static_cast<int32_t>(index), static_cast<uint32_t>(line())});
      return resolved(index, count);
    }
    bad.add(line());
    return kNoIndex;
  }

  [[noreturn]] void fail_corner(const char* p, const char* end) const {
    std::string_view rest(p, static_cast<size_t>(end - p));
    const std::string word = in_quotes(take_word(rest));
    if (p != end && *p == '/')
      fail("face {}, corner {}: {} has no vertex index; {}", face(), corners_.size() + 1, word, kFix);
    fail("face {}, corner {}: {} is not of the form v, v/vt, v//vn or v/vt/vn; {}", face(), corners_.size() + 1, word,
         kFix);
  }

  const std::filesystem::path& path_;
  ObjChunk& chunk_;
  LineScanner lines_;
  std::unordered_map<std::string, uint32_t> material_ids_;
  std::vector<ObjChunk::Corner> corners_;  // corners of the current face; kept to reuse memory
};

}  // namespace

ObjCounts count_statements(const std::filesystem::path& path, std::string_view text) {
  ObjCounts counts;
  LineScanner lines(path, LineJoin::obj, text, 0);
  try {
    for (std::string_view rest; lines.next(rest);) {
      const std::string_view statement = take_word(rest);
      counts.vertices += statement == "v";
      counts.normals += statement == "vn";
      counts.texcoords += statement == "vt";
      counts.faces += statement == "f";
    }
  } catch (const Error&) {  // read_chunk will stop at the same line
  }
  counts.lines = lines.lines();
  return counts;
}

void read_chunk(const std::filesystem::path& path, ObjChunk& chunk) {
  try {
    ChunkReader(path, chunk).read();
  } catch (...) {
    chunk.failure = std::current_exception();
  }
}

}  // namespace hybridrt
