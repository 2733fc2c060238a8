#pragma once

#include "core/base/math.h"

// shaders/surface.glsl compiled as C++, in single and in double precision. Argument types select which.
#define HRT_FN inline
#define HRT_CHOOSE(condition, a, b) ((condition) ? (a) : (b))
#define HRT_ANY(condition) (condition)
namespace hybridrt::surface_single {
using namespace glm;
using Real = float;
using Vec3 = glm::vec3;
using Mask = bool;
#include "shaders/surface.glsl"
// after it
#include "core/trace/optics-inl.h"
}  // namespace hybridrt::surface_single

namespace hybridrt::surface_double {
using namespace glm;
using Real = double;
using Vec3 = glm::dvec3;
using Mask = bool;
#include "shaders/surface.glsl"
// after it
#include "core/trace/optics-inl.h"
}  // namespace hybridrt::surface_double
#undef HRT_FN
#undef HRT_CHOOSE
#undef HRT_ANY

namespace hybridrt {
using surface_double::ambient_at;
using surface_double::clamped_barycentrics;
using surface_double::fresnel_dielectric;
using surface_double::leaving_origin;
using surface_double::met_surface;
using surface_double::normalized_or;
using surface_double::phong_light;
using surface_double::phong_unlit;
using surface_double::scattered_rays;
using surface_double::turned_toward;
using surface_single::ambient_at;
using surface_single::clamped_barycentrics;
using surface_single::fresnel_dielectric;
using surface_single::leaving_origin;
using surface_single::met_surface;
using surface_single::normalized_or;
using surface_single::phong_light;
using surface_single::phong_unlit;
using surface_single::scattered_rays;
using surface_single::turned_toward;
}  // namespace hybridrt
