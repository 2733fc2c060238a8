#pragma once

#include "core/base/math.h"

// shaders/surface.glsl compiled as C++, in single and in double precision. Argument types select which.
#define HRT_FN inline
#define HRT_CHOOSE(condition, a, b) ((condition) ? (a) : (b))
namespace hybridrt::surface_single {
using namespace glm;
using Real = float;
using Vec3 = glm::vec3;
#include "shaders/surface.glsl"
}  // namespace hybridrt::surface_single

namespace hybridrt::surface_double {
using namespace glm;
using Real = double;
using Vec3 = glm::dvec3;
#include "shaders/surface.glsl"
}  // namespace hybridrt::surface_double
#undef HRT_FN
#undef HRT_CHOOSE

namespace hybridrt {
using surface_double::ambient_at;
using surface_double::clamped_barycentrics;
using surface_double::normalized_or;
using surface_double::phong_light;
using surface_double::phong_unlit;
using surface_double::turned_toward;
using surface_single::ambient_at;
using surface_single::clamped_barycentrics;
using surface_single::normalized_or;
using surface_single::phong_light;
using surface_single::phong_unlit;
using surface_single::turned_toward;
}  // namespace hybridrt
