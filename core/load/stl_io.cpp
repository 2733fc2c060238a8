#include "core/load/stl_io.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>
#include <fstream>

#include "core/base/error.h"
#include "core/base/warnings.h"
#include "core/load/mesh_builder.h"
#include "core/load/stl_colors.h"
#include "core/load/text_lines.h"

namespace hybridrt {
namespace {

constexpr uint64_t kHeaderBytes = 84, kFacetBytes = 50;
constexpr size_t kMostCorners = 1 << 20;

template <typename T>
T little_endian(const char* bytes) {
  std::array<char, sizeof(T)> copy;
  std::memcpy(copy.data(), bytes, sizeof(T));
  if (std::endian::native == std::endian::big) std::reverse(copy.begin(), copy.end());
  return std::bit_cast<T>(copy);
}

/// Makes a facet of the corners added since `first`.
void close_facet(MeshBuilder& mesh, size_t first, size_t place) {
  std::vector<uint32_t> corners;
  for (size_t i = first; i < mesh.data.positions.size(); ++i) corners.push_back(static_cast<uint32_t>(i));
  mesh.add_face(corners, place);
}

MeshData read_binary(const std::filesystem::path& path, std::ifstream& file, uint64_t facets, Warnings& warnings) {
  MeshBuilder mesh(path, "facet");
  mesh.data.positions.reserve(3 * facets);
  std::array<char, kHeaderBytes> header;
  std::array<char, kFacetBytes> facet;
  std::vector<uint16_t> attributes;
  attributes.reserve(facets);
  file.seekg(0);
  file.read(header.data(), header.size());
  for (uint64_t i = 0; i < facets; ++i) {
    if (!file.read(facet.data(), facet.size()))
      throw error(ErrorKind::input, "{}: cut short: it ends within facet {} of {}", path.string(), i + 1, facets);
    for (size_t corner = 0; corner < 3; ++corner) {
      const char* at = facet.data() + 12 * (corner + 1);
      mesh.add_vertex({little_endian<float>(at), little_endian<float>(at + 4), little_endian<float>(at + 8)}, i);
    }
    const auto last = static_cast<uint32_t>(mesh.data.positions.size() - 1);
    mesh.add_face(std::array{last - 2, last - 1, last}, i);
    attributes.push_back(little_endian<uint16_t>(facet.data() + kFacetBytes - 2));
  }
  take_stl_colors({header.data(), kHeaderBytes - 4}, attributes, mesh.data, warnings);
  return mesh.finish(warnings);
}

std::string lower_case(std::string_view text) {
  std::string result(text);
  for (char& c : result)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  return result;
}

MeshData read_text(const std::filesystem::path& path, Warnings& warnings) {
  MeshBuilder mesh(path, "line");
  TextLines lines(path, LineJoin::none);
  bool inside = false;
  size_t first = 0, facet_line = 0;
  const auto number = [&](std::string_view& rest) {
    const std::string_view word = take_word(rest);
    const std::optional<double> value = parse_number(word);
    if (!value)
      mesh.fail(lines.line_number(),
                word.empty() ? "a number is missing" : in_quotes(word) + " is not a usable number");
    return *value;
  };
  for (std::string_view line; lines.next(line);) {
    std::string_view rest = line;
    for (std::string_view word = take_word(rest); !word.empty(); word = take_word(rest)) {
      const std::string keyword = lower_case(word);
      if (keyword == "solid" || keyword == "endsolid") {
        break;  // a name follows
      } else if (keyword == "facet") {
        if (inside) mesh.fail(facet_line, "this facet has no 'endfacet'");
        inside = true, facet_line = lines.line_number(), first = mesh.data.positions.size();
      } else if (keyword == "normal") {
        for (int i = 0; i < 3; ++i) take_word(rest);  // the normal repeats the geometry, and is often nonsense
      } else if (keyword == "vertex") {
        const double x = number(rest), y = number(rest), z = number(rest);
        if (!inside) mesh.fail(lines.line_number(), "a vertex outside of any facet");
        if (mesh.data.positions.size() - first >= kMostCorners) mesh.fail(facet_line, "a facet with too many corners");
        mesh.add_vertex({x, y, z}, lines.line_number());
      } else if (keyword == "endfacet") {
        if (!inside) mesh.fail(lines.line_number(), "'endfacet' outside of any facet");
        inside = false;
        close_facet(mesh, first, facet_line);
      } else if (keyword != "outer" && keyword != "loop" && keyword != "endloop") {
        mesh.fail(lines.line_number(), in_quotes(word) + " is not a statement of an STL file");
      }
    }
  }
  if (inside) mesh.fail(facet_line, "cut short: this facet has no 'endfacet'");
  return mesh.finish(warnings);
}

}  // namespace

MeshData read_stl(const std::filesystem::path& path, Warnings& warnings) {
  std::error_code problem;
  if (std::filesystem::is_directory(path, problem))
    throw error(ErrorKind::input, "{} is a directory; name the file in it", path.string());
  std::ifstream file(path, std::ios::binary);
  const uint64_t bytes = std::filesystem::file_size(path, problem);
  if (!file || problem) throw error(ErrorKind::input, "{} cannot be opened", path.string());
  if (bytes == 0) throw error(ErrorKind::input, "{} is empty", path.string());

  // Binary files may begin with "solid" too; their size gives them away.
  std::array<char, kHeaderBytes> header{};
  file.read(header.data(), header.size());
  const uint64_t promised = little_endian<uint32_t>(header.data() + 80);
  const bool fits = bytes >= kHeaderBytes && bytes - kHeaderBytes == promised * kFacetBytes;
  std::string_view start(header.data(), static_cast<size_t>(file.gcount()));
  start = start.substr(std::min(start.find_first_not_of(" \t\r\n\xEF\xBB\xBF"), start.size()));
  const bool is_text = lower_case(start.substr(0, 5)) == "solid" && start.find('\0') == start.npos;
  if (is_text && !fits) return read_text(path, warnings);

  const uint64_t there = bytes < kHeaderBytes ? 0 : (bytes - kHeaderBytes) / kFacetBytes;
  if (promised > there || bytes < kHeaderBytes)
    throw error(ErrorKind::input, "{}: neither text nor whole: a binary STL of {} facets, but there is room for {}",
                path.string(), promised, there);
  if (!fits)
    warnings.push_back(fmt::format("{}: {} bytes behind its {} facets were ignored", path.filename().string(),
                                   bytes - kHeaderBytes - promised * kFacetBytes, promised));
  file.clear();
  return read_binary(path, file, promised, warnings);
}

}  // namespace hybridrt
