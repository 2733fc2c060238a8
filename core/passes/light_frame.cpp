#include "core/passes/light_frame.h"

#include <algorithm>

#include "core/scene/light_axes.h"

namespace hybridrt {

dmat4 LightFrame::unit_from_scene() const {
  const dvec3 scale = 1.0 / (hi - lo);
  const dvec3 z_axis = -toward;
  return glm::transpose(dmat4(dvec4(x_axis * scale.x, -lo.x * scale.x), dvec4(y_axis * scale.y, -lo.y * scale.y),
                              dvec4(z_axis * scale.z, -lo.z * scale.z), dvec4(0, 0, 0, 1)));
}

LightFrame fit_light_frame(const Scene& scene, const dvec3& toward) {
  LightFrame frame;
  frame.toward = toward;
  const LightAxes axes = light_axes(toward);
  frame.x_axis = axes.x;
  frame.y_axis = axes.y;

  frame.lo = dvec3(std::numeric_limits<double>::infinity());
  frame.hi = -frame.lo;
  for (const uvec3& triangle : scene.triangle_positions)
    for (int corner = 0; corner < 3; ++corner) {
      const dvec3 p(scene.positions[triangle[corner]]);
      const dvec3 q(glm::dot(p, frame.x_axis), glm::dot(p, frame.y_axis), -glm::dot(p, frame.toward));
      frame.lo = glm::min(frame.lo, q);
      frame.hi = glm::max(frame.hi, q);
    }
  // A margin around the box, so that float rounding clips nothing and a flat scene has some depth.
  const dvec3 size = frame.hi - frame.lo;
  const double air = 1e-3 * std::max({size.x, size.y, size.z, 1e-30});
  frame.lo -= air;
  frame.hi += air;
  return frame;
}

}  // namespace hybridrt
