#pragma once

#include <span>
#include <vector>

#include "core/scene/view.h"

namespace hybridrt {

/// The number of blocks of receivers along a side of `pixels`.
int receiver_blocks(int pixels);

/// Points, relative to the eye, whose convex hull holds all that is seen: per block that sees something, the eight
/// corners of the part of the view between its depths. `blocks`: the nearest and the farthest depth of each block, or
/// (0, 2) where nothing is seen; row 0 on top.
std::vector<dvec3> receiver_hull(const View& view, double near_distance, std::span<const vec2> blocks);

}  // namespace hybridrt
