#pragma once

#include <cstdint>

#include "core/scene/textures.h"

namespace hybridrt {

/// How a triangle lies on its map of holes, in texels, x to the right and y downward: corner 0 at `start`, the others
/// at start + to[0] and start + to[1]. Rounded to float.
struct HolePlacement {
  float start[2], to[2][2];
  float error[2];   ///< what is_hole(), in double precision, rounds where it finds the place
  int32_t size[2];  ///< width and height of the map
  int32_t first;    ///< its first texel in Textures::words
  bool clamped;     ///< beyond the map its edge goes on; else the map repeats
};

/// The triangle must have holes.
HolePlacement hole_placement(const Textures& textures, uint32_t triangle);

}  // namespace hybridrt
