#include "core/load/off_header.h"

#include "core/base/error.h"
#include "core/base/warnings.h"

namespace hybridrt {
namespace {

struct Keyword {
  OffHeader kinds;
  bool has_small_n = false;  // nOFF: any number of dimensions, which stands before the counts
};

/// Reads the letters before "OFF". "noff" is NOFF in lower case.
Keyword parse_kinds(const MeshBuilder& mesh, std::string_view letters, bool lower_off, size_t place) {
  Keyword keyword;
  for (size_t i = 0; i < letters.size(); ++i) {
    const char c = letters[i];
    if (c == '4')
      keyword.kinds.homogeneous = true;
    else if (c == 'n' && !lower_off)
      keyword.has_small_n = true;
    else if (c == 'N' || c == 'n')
      keyword.kinds.normals = true;
    else if (c == 'C' || c == 'c')
      keyword.kinds.colors = true;
    else if (lower_case(letters.substr(i, 2)) == "st")
      keyword.kinds.texture = true, ++i;
    else
      mesh.fail(place,
                fmt::format("{} before OFF is not of ST, C, N, 4 and n: it is not an OFF file", in_quotes(letters)));
  }
  return keyword;
}

/// Takes the keyword off the first line, if there is one.
Keyword read_keyword(OffLines& lines, const MeshBuilder& mesh) {
  if (parse_number(lines.peek())) return {};
  const std::string_view word = lines.word();
  const size_t at = lower_case(word).find("off");
  const std::string_view glued = at == word.npos ? word : word.substr(at + 3);
  if (at == word.npos || !(glued.empty() || parse_number(glued)))
    mesh.fail(lines.place(), in_quotes(word) + " is not the keyword OFF: it is not an OFF file");
  lines.put_back(glued);
  if (lower_case(lines.peek()) == "binary") mesh.fail(lines.place(), "binary OFF is not read; write it as text");
  return parse_kinds(mesh, word.substr(0, at), word.substr(at, 3) == "off", lines.place());
}

/// The numbers before the first vertex: two counts and that of the edges, which may be missing; with a small n maybe
/// the dimensions before them. A line of a single number cannot be a vertex, so it goes on with the counts.
std::vector<double> read_counts(OffLines& lines, bool has_small_n, OffHeader& header) {
  std::vector<double> numbers;
  while (numbers.size() < 3 && !header.at_vertex) {
    if (lines.done()) {
      lines.next("the counts");
      header.at_vertex = numbers.size() == 2 && lines.words_left() >= 3;
    }
    if (!header.at_vertex) numbers.push_back(lines.number());
  }
  if (has_small_n && !header.at_vertex) {
    if (lines.done()) {
      lines.next("the first vertex");
      header.at_vertex = lines.words_left() > 1;
    }
    if (!header.at_vertex && (lines.words_left() == 1 || numbers[0] == 3)) numbers.push_back(lines.number());
  }
  header.one_line = !header.at_vertex && lines.words_left() >= 3;
  return numbers;
}

/// Where a comment begins, or the end. Windows writes NaN as 1.#QNAN.
size_t comment_of(std::string_view line) {
  size_t at = line.find('#');
  while (at != line.npos && line.substr(0, at).ends_with("1.")) at = line.find('#', at + 1);
  return at;
}

}  // namespace

OffHeader read_off_header(OffLines& lines, const MeshBuilder& mesh, double most) {
  lines.next("the keyword OFF");
  const Keyword keyword = read_keyword(lines, mesh);
  OffHeader header = keyword.kinds;
  std::vector<double> numbers = read_counts(lines, keyword.has_small_n, header);
  if (numbers.size() == 4) {
    if (numbers[0] != 3) mesh.fail(lines.place(), fmt::format("{:g} dimensions; only three can be drawn", numbers[0]));
    numbers.erase(numbers.begin());
  } else if (keyword.has_small_n) {
    header.normals = header.at_vertex && lines.words_left() >= 6;  // meant as NOFF
  }
  header.vertices = lines.as_count(numbers[0], most);
  header.faces = lines.as_count(numbers[1], most);  // the number of edges is rarely right
  if (header.one_line) lines.ignore_line_ends();
  return header;
}

void OffLines::next(const char* expected) {
  for (std::string_view line; lines_.next(line);) {
    rest_ = line.substr(0, comment_of(line));
    if (!done()) return;
  }
  throw error(ErrorKind::input, "{}: cut short: it ends before {}", lines_.path().string(), expected);
}

size_t OffLines::words_left() const {
  size_t words = 0;
  for (std::string_view rest = rest_; !take_word(rest).empty();) ++words;
  return words;
}

std::string_view OffLines::word() {
  if (ignores_line_ends_ && done()) next("the last face");
  return take_word(rest_);
}

std::string_view OffLines::peek() const {
  std::string_view rest = rest_;
  return take_word(rest);
}

void OffLines::put_back(std::string_view end_of_word) {
  rest_ = {end_of_word.data(), end_of_word.size() + rest_.size()};
}

double OffLines::coordinate() {
  const std::string_view text = word();
  const std::optional<double> number = parse_coordinate(text);
  if (!number) mesh_.fail(place(), text.empty() ? "a number is missing" : in_quotes(text) + " is not a usable number");
  return *number;
}

double OffLines::number() {
  const double number = coordinate();
  if (!std::isfinite(number)) mesh_.fail(place(), "NaN or infinity where a count or an index must be");
  return number;
}

size_t OffLines::as_count(double number, double most) const {
  if (!(number >= 0 && number <= most && number == std::floor(number)))
    mesh_.fail(place(), fmt::format("{:g} is not a count; it must be 0 to {:g}", number, most));
  return static_cast<size_t>(number);
}

size_t OffLines::count(double most) { return as_count(number(), most); }

}  // namespace hybridrt
