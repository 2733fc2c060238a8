#pragma once

#include <cstdint>

#include "core/scene/textures.h"

namespace hybridrt {

/// Whether the triangle has a hole at barycentric weights (1 - u - v, u, v). In double precision whatever the caller's,
/// so that all agree but for what their weights differ by. A hit in a hole is none: every caster asks.
bool is_hole(const Textures& textures, uint32_t triangle, double u, double v);

}  // namespace hybridrt
