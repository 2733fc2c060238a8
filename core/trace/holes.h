#pragma once

#include <cstdint>

#include "core/scene/textures.h"

namespace hybridrt {

/// Whether the triangle has a hole at barycentric weights (1 - u - v, u, v). In double precision for every caller, so
/// that callers differ only by their weights. A hit in a hole does not count: every caster asks.
bool is_hole(const Textures& textures, uint32_t triangle, double u, double v);

}  // namespace hybridrt
