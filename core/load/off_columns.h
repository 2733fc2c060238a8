#pragma once

#include <cstddef>
#include <vector>

#include "core/load/off_header.h"

namespace hybridrt {

/// The numbers after the positions of an OFF file's vertices, the same number for each; NaN where a line has fewer.
struct OffExtras {
  size_t per_vertex = 0;
  std::vector<double> numbers;  ///< those of the first vertex, then those of the next
};

/// Which of them mean what: a normal begins at `normal`, `color_count` numbers of a colour at `color`.
struct OffColumns {
  bool has_normals = false;
  size_t normal = 0, color = 0, color_count = 0;
};

/// Geomview writes normals before colours, MeshLab colours before normals, both whatever the keyword's order. It is the
/// order in which no colour is impossible and more of the normals are unit vectors; if that says nothing, MeshLab's.
OffColumns find_columns(const OffHeader& header, const OffExtras& extras);

}  // namespace hybridrt
