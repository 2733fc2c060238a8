#pragma once

#include "core/base/math.h"
#include "core/scene/scene.h"

namespace hybridrt {

/// The scene as a directional light sees it: an orthonormal frame whose z axis points away from the light,
/// and the box of all triangles in it. Scene space, double precision.
struct LightFrame {
  dvec3 toward{0, 1, 0};  ///< unit, toward the light
  dvec3 x_axis{1, 0, 0}, y_axis{0, 0, 1};
  dvec3 lo{0}, hi{1};  ///< along x_axis, y_axis and -toward; never empty along any of them

  /// Maps a position to its place in the box: x, y, z each 0..1, z growing away from the light.
  dmat4 unit_from_scene() const;
};

/// `toward` must be unit. Goes through all vertices of all triangles; keep the result while light and scene stand
/// still.
LightFrame fit_light_frame(const Scene& scene, const dvec3& toward);

}  // namespace hybridrt
