#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/base/math.h"

namespace hybridrt {

/// Cuts a polygon of n >= 3 corners into n - 2 triangles, appended to `triangles` as corner numbers with
/// the polygon's own winding. Concave polygons come out right, and so do collinear and repeated corners,
/// which give triangles of zero area. Quads are cut along their inner, then their shorter diagonal; larger
/// polygons, seen along their normal, by ear clipping: the corners that could lie inside an ear are kept
/// in a grid, which makes 100,000 corners a matter of milliseconds.
///
/// False when the polygon crosses itself or has no area, so that no cut is right; the triangles are there
/// all the same. Time is bounded whatever the polygon: about a second for a million corners.
/// Source: Eberly, Triangulation by Ear Clipping, 2002; Newell's normal after Sutherland et al. 1974.
bool triangulate_polygon(std::span<const dvec3> corners, std::vector<uvec3>& triangles);

}  // namespace hybridrt
