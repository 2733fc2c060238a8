#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace hybridrt {

enum class PlyType { int8, uint8, int16, uint16, int32, uint32, float32, float64 };
size_t size_of(PlyType type);

struct PlyProperty {
  std::string name;  ///< in lower case, whatever the file's
  PlyType type;
  bool is_list = false;
  PlyType count_type = PlyType::uint8;  ///< the type of a list's length
};

struct PlyElement {
  std::string name;  ///< likewise
  uint64_t count = 0;
  std::vector<PlyProperty> properties;  ///< at least one

  /// The index of the property with this name, or -1.
  int find(std::string_view property) const;
  /// That of the list of corners of a face or strip, or -1.
  int find_corners() const;
};

/// A texture that a comment "TextureFile NAME" names.
struct PlyTexture {
  std::string name;
  size_t line = 0;
};

enum class PlyFormat { ascii, little_endian, big_endian };

struct PlyHeader {
  PlyFormat format = PlyFormat::ascii;
  std::vector<PlyElement> elements;  ///< in the file's order
  std::vector<PlyTexture> textures;
  size_t bytes = 0, lines = 0;  ///< size of the header, including the end_header line
};

/// The fewest bytes that an element can take: as text a digit and a blank per number.
uint64_t least_bytes(const PlyElement& element, PlyFormat format);

/// Reads the header and checks its counts against the file's size, so that memory reserved for them is bounded by the
/// file. Throws Error (input), naming file and line, if the file is missing, a directory or not PLY, for an unknown
/// format or type, and for more elements than the file has room for.
PlyHeader read_ply_header(const std::filesystem::path& path);

}  // namespace hybridrt
