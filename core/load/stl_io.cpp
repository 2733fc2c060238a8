#include "core/load/stl_io.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>
#include <fstream>
#include <span>

#include "core/base/error.h"
#include "core/base/input_file.h"
#include "core/base/warnings.h"
#include "core/load/mesh_builder.h"
#include "core/load/stl_colors.h"
#include "core/load/text_lines.h"

namespace hybridrt {
namespace {

constexpr uint64_t kHeaderBytes = 84, kFacetBytes = 50;
constexpr uint64_t kUnknownCount = 0xFFFFFFFF;  // as 0, by writers that do not go back to fill it in
constexpr size_t kMostCorners = 1 << 20;

template <typename T>
T little_endian(const char* bytes) {
  std::array<char, sizeof(T)> copy;
  std::memcpy(copy.data(), bytes, sizeof(T));
  if (std::endian::native == std::endian::big) std::reverse(copy.begin(), copy.end());
  return std::bit_cast<T>(copy);
}

/// Adds facets to a mesh, but none with a corner that is no position.
class FacetBuilder {
 public:
  explicit FacetBuilder(MeshBuilder& mesh) : mesh_(mesh) {}

  /// Whether it was added.
  bool add(std::span<const dvec3> corners, size_t place) {
    for (const dvec3& corner : corners)
      if (!is_usable(corner)) {
        if (bad_.count == 0) first_fault_ = fault_of_position(corner);
        bad_.add(place);
        return false;
      }
    indices_.clear();
    for (const dvec3& corner : corners) {
      indices_.push_back(static_cast<uint32_t>(mesh_.data.positions.size()));
      mesh_.add_vertex(corner, place);
    }
    mesh_.add_face(indices_, place);
    return true;
  }

  MeshData finish(Warnings& warnings) {
    if (bad_.count > 0 && mesh_.data.faces == 0)
      mesh_.fail(bad_.first_line, first_fault_ + ", and no other facet is left; export the mesh again");
    report(WarningCode::vertex_unusable, bad_,
           "facets with a corner that is NaN, infinite or not below 1e30 were left out", mesh_.data.path, warnings,
           mesh_.data.place);
    return mesh_.finish(warnings);
  }

 private:
  MeshBuilder& mesh_;
  Tally bad_;
  std::string first_fault_;
  std::vector<uint32_t> indices_;
};

MeshData read_binary(const std::filesystem::path& path, std::ifstream& file, uint64_t count, Warnings& warnings) {
  MeshBuilder mesh(path, "facet");
  FacetBuilder facets(mesh);
  mesh.data.positions.reserve(3 * count);
  std::array<char, kHeaderBytes> header;
  std::array<char, kFacetBytes> facet;
  std::vector<uint16_t> attributes;
  attributes.reserve(count);
  file.seekg(0);
  file.read(header.data(), header.size());
  for (uint64_t i = 0; i < count; ++i) {
    if (!file.read(facet.data(), facet.size()))
      throw error(ErrorKind::input, "{}: cut short: it ends within facet {} of {}", path.string(), i + 1, count);
    std::array<dvec3, 3> corners;
    for (size_t corner = 0; corner < 3; ++corner) {
      const char* at = facet.data() + 12 * (corner + 1);
      corners[corner] = {little_endian<float>(at), little_endian<float>(at + 4), little_endian<float>(at + 8)};
    }
    if (facets.add(corners, i)) attributes.push_back(little_endian<uint16_t>(facet.data() + kFacetBytes - 2));
  }
  take_stl_colors({header.data(), kHeaderBytes - 4}, attributes, mesh.data, warnings);
  return facets.finish(warnings);
}

/// The statements of a text file, word by word.
class TextFacets {
 public:
  TextFacets(const std::filesystem::path& path) : mesh_(path, "line"), facets_(mesh_), lines_(path, LineJoin::none) {}

  MeshData read(Warnings& warnings) {
    for (std::string_view line; lines_.next(line);) {
      if (trimmed(line).starts_with('#')) continue;
      std::string_view rest = line;
      for (std::string_view word = take_word(rest); !word.empty(); word = take_word(rest)) read_statement(word, rest);
    }
    if (in_facet_) mesh_.fail(facet_line_, "cut short: this facet has no 'endfacet'");
    if (in_solid_) unended_.add(solid_line_);
    report(WarningCode::file_cut_short, unended_, "solids have no 'endsolid'; is the file cut short?", mesh_.data.path,
           warnings);
    return facets_.finish(warnings);
  }

 private:
  size_t line() const { return lines_.line_number(); }

  void read_statement(std::string_view word, std::string_view& rest) {
    const std::string keyword = lower_case(word);
    if (keyword == "solid" || keyword == "endsolid") {
      end_solid(keyword == "solid");
      rest = {};  // a name follows
    } else if (keyword == "facet") {
      if (in_facet_) mesh_.fail(facet_line_, "this facet has no 'endfacet'");
      if (!in_solid_) in_solid_ = true, solid_line_ = line();
      in_facet_ = true, facet_line_ = line();
      corners_.clear();
    } else if (keyword == "normal") {
      for (int i = 0; i < 3; ++i) take_word(rest);  // the normal repeats the geometry, and is often nonsense
    } else if (keyword == "vertex") {
      const double x = number(rest), y = number(rest), z = number(rest);
      if (!in_facet_) mesh_.fail(line(), "a vertex outside of any facet");
      if (corners_.size() >= kMostCorners) mesh_.fail(facet_line_, "a facet with too many corners");
      corners_.emplace_back(x, y, z);
    } else if (keyword == "endfacet") {
      if (!in_facet_) mesh_.fail(line(), "'endfacet' outside of any facet");
      in_facet_ = false;
      facets_.add(corners_, facet_line_);
    } else if (keyword != "outer" && keyword != "loop" && keyword != "endloop") {
      mesh_.fail(line(), in_quotes(word) + " is not a statement of an STL file; remove it or export the mesh again");
    }
  }

  /// Ends the solid before this line, and begins the next.
  void end_solid(bool begins) {
    if (begins && in_solid_) unended_.add(solid_line_);
    in_solid_ = begins, solid_line_ = line();
  }

  double number(std::string_view& rest) {
    const std::string_view word = take_word(rest);
    const std::optional<double> value = parse_coordinate(word);
    if (!value) mesh_.fail(line(), word.empty() ? "a number is missing" : in_quotes(word) + " is not a usable number");
    return *value;
  }

  MeshBuilder mesh_;
  FacetBuilder facets_;
  TextLines lines_;
  std::vector<dvec3> corners_;  // of the facet
  bool in_facet_ = false, in_solid_ = false;
  size_t facet_line_ = 0, solid_line_ = 0;
  Tally unended_;
};

/// The beginning of a file, enough to tell text from numbers.
std::string beginning_of(std::ifstream& file) {
  std::string start(4096, '\0');
  file.read(start.data(), static_cast<std::streamsize>(start.size()));
  start.resize(static_cast<size_t>(file.gcount()));
  file.clear();
  return start;
}

/// Whether a file that begins like this is text. Binary files may begin with "solid" too, but numbers have bytes that
/// text has not: the two that end a facet are nearly always 0. Text with such bytes, as UTF-16 is, has words all the
/// same.
bool looks_like_text(std::string_view start) {
  std::string words = lower_case(start);
  std::erase(words, '\0');
  if (words.find("facet") != words.npos && words.find("vertex") != words.npos) return true;
  return std::all_of(start.begin(), start.end(),
                     [](char c) { return static_cast<unsigned char>(c) >= 32 ? c != 127 : c >= '\t' && c <= '\r'; });
}

}  // namespace

MeshData read_stl(const std::filesystem::path& path, Warnings& warnings) {
  require_regular_file(path);
  std::error_code problem;
  std::ifstream file(path, std::ios::binary);
  const uint64_t bytes = std::filesystem::file_size(path, problem);
  if (!file || problem) throw error(ErrorKind::input, "{} cannot be opened", path.string());
  if (bytes == 0) throw error(ErrorKind::input, "{} is empty", path.string());

  const std::string start = beginning_of(file);
  const uint64_t promised = bytes < kHeaderBytes ? 0 : little_endian<uint32_t>(start.data() + kHeaderBytes - 4);
  const uint64_t there = bytes < kHeaderBytes ? 0 : (bytes - kHeaderBytes) / kFacetBytes;
  const bool whole = bytes >= kHeaderBytes && (bytes - kHeaderBytes) % kFacetBytes == 0;
  if (!(whole && promised == there && there > 0) && looks_like_text(start)) return TextFacets(path).read(warnings);

  uint64_t facets = promised;
  if ((promised == 0 || promised == kUnknownCount) && whole && there > 0) {
    warnings.emplace_back(WarningCode::facets_miscounted,
                          fmt::format("{}: its header promises {} facets, but its size is that of {}, which were read",
                                      path.filename().string(), promised, there));
    facets = there;
  }
  if (facets > there || bytes < kHeaderBytes)
    throw error(ErrorKind::input,
                "{}: neither text nor whole: a binary STL of {} facets, but there is room for {}; is it cut short?",
                path.string(), facets, there);
  if (facets == 0 && bytes > kHeaderBytes)
    throw error(ErrorKind::input,
                "{}: its header promises 0 facets, and its {} bytes are not whole facets either; export it again",
                path.string(), bytes);
  if (const uint64_t more = bytes - kHeaderBytes - facets * kFacetBytes; more > 0)
    warnings.emplace_back(WarningCode::file_has_more, fmt::format("{}: {} bytes behind its {} facets were ignored",
                                                                  path.filename().string(), more, facets));
  return read_binary(path, file, facets, warnings);
}

bool is_text_stl(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  return looks_like_text(beginning_of(file));
}

}  // namespace hybridrt
