#include "core/load/off_io.h"

#include <algorithm>
#include <limits>
#include <optional>

#include "core/base/error.h"
#include "core/base/warnings.h"
#include "core/load/mesh_builder.h"
#include "core/load/mesh_colors.h"
#include "core/load/text_lines.h"

namespace hybridrt {
namespace {

constexpr double kMostCorners = 1 << 20;  // per polygon

/// The statements of an OFF file: its lines without comments and blank lines.
class OffLines {
 public:
  OffLines(const std::filesystem::path& path, const MeshBuilder& mesh) : lines_(path, LineJoin::none), mesh_(mesh) {}

  void next(const char* expected) {
    for (std::string_view line; lines_.next(line);) {
      rest_ = line.substr(0, line.find('#'));
      if (!done()) return;
    }
    throw error(ErrorKind::input, "{}: cut short: it ends before {}", lines_.path().string(), expected);
  }

  bool done() const { return trimmed(rest_).empty(); }
  size_t words_left() const {
    size_t count = 0;
    for (std::string_view rest = rest_; !take_word(rest).empty();) ++count;
    return count;
  }
  std::string_view word() { return take_word(rest_); }
  bool next_word_is(std::string_view expected) const {
    std::string_view peek = rest_;
    return take_word(peek) == expected;
  }
  size_t place() const { return lines_.line_number(); }

  double number() {
    const std::string_view text = word();
    const std::optional<double> number = parse_number(text);
    if (!number)
      mesh_.fail(place(), text.empty() ? "a number is missing" : in_quotes(text) + " is not a usable number");
    return *number;
  }

  size_t count(double most) {
    const double value = number();
    if (!(value >= 0 && value <= most && value == std::floor(value)))
      mesh_.fail(place(), fmt::format("{:g} is not a count; it must be 0 to {:g}", value, most));
    return static_cast<size_t>(value);
  }

 private:
  TextLines lines_;
  const MeshBuilder& mesh_;
  std::string_view rest_;
};

/// What follows each position, by the keyword: [ST][C][N][4][n]OFF.
struct OffKind {
  bool normals = false, colors = false, texture = false;
};

OffKind parse_keyword(const MeshBuilder& mesh, std::string_view keyword, size_t place) {
  OffKind kind;
  const std::string_view whole = keyword;
  if (keyword.starts_with("ST")) kind.texture = true, keyword.remove_prefix(2);
  if (keyword.starts_with("C")) kind.colors = true, keyword.remove_prefix(1);
  if (keyword.starts_with("N")) kind.normals = true, keyword.remove_prefix(1);
  if (keyword == "4OFF" || keyword == "nOFF" || keyword == "4nOFF")
    mesh.fail(place, fmt::format("{} does not have three dimensions", in_quotes(whole)));
  if (keyword != "OFF")
    mesh.fail(place, fmt::format("{} is not the keyword OFF: it is not an OFF file", in_quotes(whole)));
  return kind;
}

/// Appends a vertex's colour, if any vertex so far has one. `before`: the vertices before it.
void add_color(std::vector<vec3>& colors, size_t before, const vec3& color) {
  if (color == kNoColor && colors.empty()) return;
  colors.resize(before, kNoColor);
  colors.push_back(color);
}

/// Reads a colour, three numbers or four with alpha, which are all that is left of the line but `behind` numbers. Other
/// colours, of colour maps, are counted in `unread`.
vec3 read_color(OffLines& lines, size_t behind, MeshBuilder& mesh, Tally& unread) {
  const size_t there = lines.words_left(), count = there - std::min(there, behind);
  if (count == 0) return kNoColor;
  if (count < 3) {
    unread.add(lines.place());
    return kNoColor;
  }
  dvec3 numbers;
  for (int i = 0; i < 3; ++i) {
    const std::optional<double> number = parse_number(lines.word());
    numbers[i] = number.value_or(std::numeric_limits<double>::quiet_NaN());
  }
  if (count > 3) mesh.add_alpha(parse_number(lines.word()).value_or(1), 1, lines.place());
  const vec3 color = color_of_numbers(numbers);
  if (color == kNoColor) unread.add(lines.place());
  return color;
}

}  // namespace

MeshData read_off(const std::filesystem::path& path, Warnings& warnings) {
  MeshBuilder mesh(path, "line");
  OffLines lines(path, mesh);
  lines.next("the keyword OFF");
  const OffKind kind = parse_keyword(mesh, lines.word(), lines.place());
  if (lines.next_word_is("BINARY")) mesh.fail(lines.place(), "binary OFF is not read; write it as text");
  if (lines.done()) lines.next("the counts");
  const auto most = static_cast<double>(std::filesystem::file_size(path));  // one line each
  const size_t vertices = lines.count(most), faces = lines.count(most);
  if (!lines.done()) lines.number();  // the number of edges, which is rarely right

  Tally unread;
  for (size_t i = 0; i < vertices; ++i) {
    lines.next("the last vertex");
    const double x = lines.number(), y = lines.number(), z = lines.number();
    mesh.add_vertex({x, y, z}, lines.place());
    if (kind.normals) {
      const double nx = lines.number(), ny = lines.number(), nz = lines.number();
      mesh.add_normal({nx, ny, nz});
    }
    add_color(mesh.data.colors, i, read_color(lines, kind.texture ? 2 : 0, mesh, unread));
  }
  std::vector<uint32_t> corners;
  for (size_t i = 0; i < faces; ++i) {
    lines.next("the last face");
    const size_t count = lines.count(kMostCorners);
    corners.clear();
    while (corners.size() < count) corners.push_back(mesh.corner(lines.number(), vertices, lines.place()));
    MeshBuilder::FaceExtras extras;
    const vec3 color = read_color(lines, 0, mesh, unread);
    if (color != kNoColor) extras.color = mesh.add_face_color(color);
    mesh.add_face(corners, lines.place(), extras);
  }
  report(unread, "vertices and faces have colours that are not three or four numbers, and were left out", path,
         warnings);
  if (kind.texture)
    warnings.push_back(path.filename().string() + ": texture coordinates were left out: OFF names no texture");
  return mesh.finish(warnings);
}

}  // namespace hybridrt
