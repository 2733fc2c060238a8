#pragma once

#include <span>
#include <string>

#include "core/base/warnings.h"
#include "core/load/mesh_data.h"

namespace hybridrt {

/// A vertex whose position is not finite or not below kLargestCoordinate. Depth cameras write them for what they did
/// not see.
struct BadVertex {
  size_t vertex;  ///< index into MeshData::positions, where the position is as read
  size_t place;   ///< for messages
};

bool is_usable(const dvec3& position);

/// "its x coordinate is NaN", or infinite, or not below 1e30.
std::string fault_of_position(const dvec3& position);

/// The first of the vertices that a triangle uses, or null. If there is none, gives them a position that others have,
/// so that all positions are finite, and warns.
const BadVertex* settle_bad_vertices(MeshData& mesh, std::span<const BadVertex> bad, Warnings& warnings);

}  // namespace hybridrt
