#pragma once

#include <span>
#include <vector>

#include "core/scene/view.h"

namespace hybridrt {

/// Blocks of pixels, each with its nearest and farthest depth, along a side of `pixels`.
int receiver_blocks(int pixels);

/// Points whose convex hull holds all that is seen, relative to the eye: of each block that sees something the eight
/// corners of the part of the view between its depths. `blocks`: the nearest and the farthest depth of each, or (0, 2)
/// where nothing is seen; row 0 on top.
std::vector<dvec3> receiver_hull(const View& view, double near_distance, std::span<const vec2> blocks);

}  // namespace hybridrt
