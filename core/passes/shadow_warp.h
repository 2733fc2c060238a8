#pragma once

#include "core/passes/shadow_map_fit.h"

// shaders/shadow_warp.glsl compiled as C++, in single and in double precision.
#define HRT_FN inline
namespace hybridrt::shadow_warp_single {
using namespace glm;
using Real = float;
using Vec2 = glm::vec2;
using Vec3 = glm::vec3;
#include "shaders/shadow_warp.glsl"
}  // namespace hybridrt::shadow_warp_single

namespace hybridrt::shadow_warp_double {
using namespace glm;
using Real = double;
using Vec2 = glm::dvec2;
using Vec3 = glm::dvec3;
#include "shaders/shadow_warp.glsl"
}  // namespace hybridrt::shadow_warp_double
#undef HRT_FN

namespace hybridrt {

/// What the shadow test reads of a fit, as both forms of the test read it.
shadow_warp_single::MapFit map_fit_of(const ShadowMapFit& fit);

/// (u w, v w, z, w) of ShadowMapFit from a position relative to the eye.
mat4 map_from_eye(const ShadowMapFit& fit, const dvec3& eye);

}  // namespace hybridrt
