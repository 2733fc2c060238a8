#pragma once

#include "core/raster/depth_tile.h"
#include "core/raster/pixel_samples.h"
#include "core/raster/screen.h"
#include "core/scene/scene.h"

namespace hybridrt {

/// Decides the tile's pending samples and empties their list. Each is settled by the reference's own test
/// (intersect_triangle in double precision, is_hole, the ties of NearestHit) between the sample's triangle and the one
/// that the pixel has, so that the result does not depend on the order of the samples.
void settle(const Scene& scene, const Screen& screen, DepthTile& tile);

/// The same where pixels have several samples: a pending sample's place is one in the arrays of `samples`.
void settle(const Scene& scene, const Screen& screen, PixelSamples& samples, DepthTile& tile);

}  // namespace hybridrt
