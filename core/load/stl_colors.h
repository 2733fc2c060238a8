#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

#include "core/base/warnings.h"
#include "core/load/mesh_data.h"

namespace hybridrt {

/// Gives a mesh the colours of the two attribute bytes of a binary STL's facets.
///  - VisCAM, SolidView: bit 15 says that the facet has a colour, of five bits each; blue are the lowest.
///  - Magics, where `header` (the first 80 bytes) says COLOR= and four bytes of red, green, blue, alpha: that is the
///    object's colour, bit 15 says that the facet has no other, and red are the lowest five bits. Where no facet says
///    anything, the object's colour counts.
/// `attributes`: one for each triangle of the mesh, in order. Those that are no colours mean nothing.
void take_stl_colors(std::string_view header, const std::vector<uint16_t>& attributes, MeshData& mesh,
                     Warnings& warnings);

}  // namespace hybridrt
