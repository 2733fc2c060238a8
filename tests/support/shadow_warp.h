#pragma once

#include <glm/glm.hpp>

// shaders/shadow_warp.glsl compiled as C++ for tests, in single and in double precision.
#define HRT_FN inline
namespace hybridrt::shadow_warp_single {
using namespace glm;
using Real = float;
using Vec2 = glm::vec2;
#include "shaders/shadow_warp.glsl"
}  // namespace hybridrt::shadow_warp_single

namespace hybridrt::shadow_warp_double {
using namespace glm;
using Real = double;
using Vec2 = glm::dvec2;
#include "shaders/shadow_warp.glsl"
}  // namespace hybridrt::shadow_warp_double
#undef HRT_FN
