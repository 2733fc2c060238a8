#include "core/passes/shadow_warp.h"

#include <glm/gtc/matrix_transform.hpp>

namespace hybridrt {

shadow_warp_single::MapFit map_fit_of(const ShadowMapFit& fit) {
  const auto single = [](double x) { return static_cast<float>(x); };
  return {single(fit.inverse_w_slope),
          single(fit.texel_across),
          single(fit.texel_along),
          single(fit.uniform_texel),
          single(fit.misplacement),
          single(fit.lean_first),
          single(fit.lean_step),
          fit.warped ? 1 : 0,
          vec3(fit.across),
          vec3(fit.along)};
}

mat4 map_from_eye(const ShadowMapFit& fit, const dvec3& eye) {
  return mat4(fit.map_from_origin * glm::translate(dmat4(1), eye - fit.origin));
}

}  // namespace hybridrt
