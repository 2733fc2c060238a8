#pragma once

#include "core/scene/material.h"

namespace hybridrt {

/// A slightly glossy colour, or the mirror of it: illum 3, Ks 0.5, the name with `_mirror` behind it.
Material painted(std::string name, const vec3& kd, bool mirror = false);

/// Turns a material into a mirror that keeps half of its colour: with Ks 0.5 it still sends back no more
/// light than it gets.
void make_mirror(Material& material);

}  // namespace hybridrt
