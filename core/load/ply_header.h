#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace hybridrt {

enum class PlyType { int8, uint8, int16, uint16, int32, uint32, float32, float64 };
size_t size_of(PlyType type);

struct PlyProperty {
  std::string name;
  PlyType type;
  bool is_list = false;
  PlyType count_type = PlyType::uint8;  ///< of a list
};

struct PlyElement {
  std::string name;
  uint64_t count = 0;
  std::vector<PlyProperty> properties;  ///< at least one

  /// The place of the property with this name, or -1.
  int find(std::string_view property) const;
};

enum class PlyFormat { ascii, little_endian, big_endian };

struct PlyHeader {
  PlyFormat format = PlyFormat::ascii;
  std::vector<PlyElement> elements;  ///< in the file's order
  size_t bytes = 0, lines = 0;       ///< of the header, up to and with the end_header line
};

/// Reads the header and holds its counts against the file's size: what it promises fits, so that memory
/// reserved for it is bounded by the file. Throws Error (input) naming file and line: missing, a directory,
/// not PLY, a format or type that is none, more than is there.
PlyHeader read_ply_header(const std::filesystem::path& path);

}  // namespace hybridrt
