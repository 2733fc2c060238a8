#pragma once

#include <cstdint>
#include <vector>

#include "core/scene/scene.h"
#include "core/scene/view.h"

namespace hybridrt {

/// How far a raster may move a corner, as a share of its distance: four times what it was seen to do.
constexpr double kCornerError = 0x1p-25;

/// The angle of a pixel of the frame, in radians.
inline double pixel_angle(const View& view) { return 2 * view.tan_half_height / view.frame_height_px; }

/// Whether a triangle as long as the scene is wide would be misplaced if its nearest point were `distance` away.
bool may_be_misplaced(const Scene& scene, const View& view, double distance);

/// The triangles that pass so near to the eye and reach so far that single precision, a raster's or a ray's, may show
/// them a noticeable part of a pixel beside their place: its error grows with the distance of the farthest corner, not
/// of what is seen. In increasing order; empty in all but scenes that are thousands of times as large as what is
/// looked at. Goes through all triangles.
std::vector<uint32_t> misplaced_triangles(const Scene& scene, const View& view);

}  // namespace hybridrt
