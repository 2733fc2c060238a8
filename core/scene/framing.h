#pragma once

#include "core/scene/scene.h"

namespace hybridrt {

/// What a picture of the whole scene should show.
struct Framing {
  Aabb bounds;          ///< scene space: of all triangles but the stray ones
  size_t left_out = 0;  ///< the number of stray triangles
  vec3 an_outlier{0};   ///< scene space: a corner of one of them
};

/// Stray geometry is at most 1 % of the triangles (or four of them), holds less than 1 % of the area, and makes the
/// scene at least four times as large: a forgotten triangle far away, before which the model would be a speck.
Framing frame_scene(const Scene& scene);

}  // namespace hybridrt
