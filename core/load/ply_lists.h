#pragma once

#include <cmath>
#include <cstddef>

#include "core/load/mesh_builder.h"
#include "core/load/ply_header.h"

// Lists of PLY elements. `Values` is PlyTextValues or PlyBinaryValues.

namespace hybridrt {

inline constexpr double kMostListed = 1 << 20;       // corners of one polygon, numbers of any other list
inline constexpr double kMostInStrips = 1ull << 32;  // Lucy is one list of thirty million

/// Reads the length of the next list.
template <typename Values>
size_t list_length(Values& values, const PlyProperty& property, const MeshBuilder& mesh, uint64_t index,
                   double most = kMostListed) {
  const double count = values.next(property.count_type);
  if (!(count >= 0 && count <= most && count == std::floor(count)))
    mesh.fail(values.place(index), fmt::format("a list of {:g} numbers; there must be 0 to {}", count, most));
  values.require(static_cast<uint64_t>(count), property.type);
  return static_cast<size_t>(count);
}

/// Leaves a property out.
template <typename Values>
void skip(Values& values, const PlyProperty& property, const MeshBuilder& mesh, uint64_t index) {
  const size_t count = property.is_list ? list_length(values, property, mesh, index) : 1;
  for (size_t i = 0; i < count; ++i) values.next(property.type);
}

}  // namespace hybridrt
