#include "core/load/ply_header.h"

#include <algorithm>
#include <charconv>
#include <fstream>
#include <map>

#include "core/base/error.h"
#include "core/base/input_file.h"
#include "core/base/warnings.h"
#include "core/load/text_scan.h"

namespace hybridrt {
namespace {

constexpr size_t kLongestHeader = 1 << 16;

const std::map<std::string, PlyType> kTypes = {
    {"char", PlyType::int8},      {"int8", PlyType::int8},       {"uchar", PlyType::uint8},
    {"uint8", PlyType::uint8},    {"short", PlyType::int16},     {"int16", PlyType::int16},
    {"ushort", PlyType::uint16},  {"uint16", PlyType::uint16},   {"int", PlyType::int32},
    {"int32", PlyType::int32},    {"uint", PlyType::uint32},     {"uint32", PlyType::uint32},
    {"float", PlyType::float32},  {"float32", PlyType::float32}, {"double", PlyType::float64},
    {"float64", PlyType::float64}};
const std::map<std::string, PlyFormat> kFormats = {{"ascii", PlyFormat::ascii},
                                                   {"binary_little_endian", PlyFormat::little_endian},
                                                   {"binary_big_endian", PlyFormat::big_endian}};

struct HeaderText {
  const std::filesystem::path& path;
  std::string_view rest;
  size_t line = 0;

  [[noreturn]] void fail(const std::string& problem) const {
    throw error(ErrorKind::input, "{}:{}: {}", path.string(), line, problem);
  }

  /// Lines end in LF, CRLF or CR, all alike.
  std::string_view next() {
    ++line;
    const size_t stop = rest.find_first_of("\r\n");
    if (stop == rest.npos) fail("the PLY header has no end (or is longer than 64 KiB)");
    const std::string_view text = rest.substr(0, stop);
    rest.remove_prefix(stop + 1 + (rest.substr(stop).starts_with("\r\n") ? 1 : 0));
    return text;
  }

  PlyType type(std::string_view name) const {
    const auto found = kTypes.find(lower_case(name));
    if (found == kTypes.end()) fail(fmt::format("{} is not a PLY number type", in_quotes(name)));
    return found->second;
  }
};

PlyElement parse_element(const HeaderText& header, std::string_view rest) {
  PlyElement element;
  element.name = lower_case(take_word(rest));
  const std::string_view count = take_word(rest);
  const auto [stop, status] = std::from_chars(count.data(), count.data() + count.size(), element.count);
  if (element.name.empty() || count.empty() || status != std::errc() || stop != count.data() + count.size())
    header.fail(fmt::format("{} is not a number of elements", in_quotes(count)));
  return element;
}

PlyProperty parse_property(const HeaderText& header, std::string_view rest) {
  PlyProperty property;
  std::string_view word = take_word(rest);
  if (lower_case(word) == "list") {
    property.is_list = true;
    property.count_type = header.type(take_word(rest));
    if (property.count_type == PlyType::float32 || property.count_type == PlyType::float64)
      header.fail("a list cannot be counted in fractions");
    word = take_word(rest);
  }
  property.type = header.type(word);
  property.name = lower_case(take_word(rest));
  if (property.name.empty()) header.fail("a property needs a name");
  return property;
}

void read_comment(std::string_view comment, size_t line, PlyHeader& header) {
  const std::string keyword = lower_case(take_word(comment));
  comment = trimmed(comment);
  if (keyword == "texturefile" && !comment.empty()) header.textures.push_back({std::string(comment), line});
}

void require_room(const std::filesystem::path& path, const PlyHeader& header, uint64_t file_bytes) {
  uint64_t left = file_bytes - header.bytes + 1;  // as text the last number needs no blank
  for (const PlyElement& element : header.elements) {
    const uint64_t least = least_bytes(element, header.format);
    if (element.count > left / least)
      throw error(ErrorKind::input,
                  "{}: the header promises {} elements '{}' but the file has only {} bytes; is it cut short?",
                  path.string(), element.count, element.name, file_bytes);
    left -= element.count * least;
  }
}

}  // namespace

size_t size_of(PlyType type) {
  switch (type) {
    case PlyType::int8:
    case PlyType::uint8: return 1;
    case PlyType::int16:
    case PlyType::uint16: return 2;
    case PlyType::float64: return 8;
    default: return 4;
  }
}

int PlyElement::find(std::string_view property) const {
  for (size_t i = 0; i < properties.size(); ++i)
    if (properties[i].name == property) return static_cast<int>(i);
  return -1;
}

int PlyElement::find_corners() const {
  for (const char* known : {"vertex_indices", "vertex_index", "vertex_indexes"})
    if (const int found = find(known); found >= 0 && properties[static_cast<size_t>(found)].is_list) return found;
  return -1;
}

uint64_t least_bytes(const PlyElement& element, PlyFormat format) {
  uint64_t bytes = 0;
  for (const PlyProperty& property : element.properties)
    bytes += format == PlyFormat::ascii ? 2 : size_of(property.is_list ? property.count_type : property.type);
  return bytes;
}

PlyHeader read_ply_header(const std::filesystem::path& path) {
  require_regular_file(path);
  std::error_code problem;
  std::ifstream file(path, std::ios::binary);
  const uint64_t file_bytes = std::filesystem::file_size(path, problem);
  if (!file || problem) throw error(ErrorKind::input, "{} cannot be opened", path.string());
  std::string start(kLongestHeader, '\0');
  file.read(start.data(), static_cast<std::streamsize>(start.size()));
  start.resize(static_cast<size_t>(file.gcount()));

  HeaderText text{path, start};
  if (!start.starts_with("ply") || trimmed(text.next()) != "ply")
    throw error(ErrorKind::input, "{} does not begin with 'ply': it is not a PLY file", path.string());
  PlyHeader header;
  bool has_format = false;
  for (;;) {
    std::string_view rest = text.next();
    const std::string keyword = lower_case(take_word(rest));
    if (keyword == "end_header") break;
    if (keyword == "comment" || keyword == "obj_info") read_comment(rest, text.line, header);
    if (keyword.empty() || keyword == "comment" || keyword == "obj_info") continue;
    if (keyword == "format") {
      const std::string_view name = take_word(rest);
      const auto known = kFormats.find(lower_case(name));
      if (known == kFormats.end()) text.fail(fmt::format("{} is not a PLY format", in_quotes(name)));
      header.format = known->second;
      has_format = true;
    } else if (keyword == "element") {
      header.elements.push_back(parse_element(text, rest));
    } else if (keyword == "property") {
      if (header.elements.empty()) text.fail("a property before any element");
      header.elements.back().properties.push_back(parse_property(text, rest));
    } else {
      text.fail(fmt::format("{} is not a statement of a PLY header", in_quotes(keyword)));
    }
  }
  if (!has_format) text.fail("the header does not say its format");
  std::erase_if(header.elements, [](const PlyElement& e) { return e.count == 0; });
  for (const PlyElement& element : header.elements)
    if (element.properties.empty()) text.fail(fmt::format("element {} has no properties", in_quotes(element.name)));
  header.bytes = start.size() - text.rest.size();
  header.lines = text.line;
  require_room(path, header, file_bytes);
  return header;
}

}  // namespace hybridrt
