#pragma once

#include "core/scene/material.h"

namespace hybridrt {

/// A slightly glossy colour, or its mirror: illum 3, Ks 0.5, `_mirror` appended to the name.
Material painted(std::string name, const vec3& kd, bool mirror = false);

/// Turns a material into a mirror that keeps half of its colour: with Ks 0.5 it still reflects no more light than it
/// gets.
void make_mirror(Material& material);

}  // namespace hybridrt
