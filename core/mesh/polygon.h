#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/base/math.h"

namespace hybridrt {

/// Cuts a polygon of n >= 3 corners into n - 2 triangles, appended to `triangles` as corner numbers with the polygon's
/// own winding. Handles concave polygons, and collinear and repeated corners, which give triangles of zero area. Quads
/// are cut along an inner diagonal, the shorter of two; larger polygons, seen along their normal, by ear clipping. The
/// corners that could lie inside an ear are kept in a grid, so that 100,000 corners take milliseconds.
///
/// False if the polygon crosses itself or has no area, so that no cut is right; triangles are appended all the same.
/// Time is bounded whatever the polygon: about a second for a million corners. Source: Eberly, Triangulation by Ear
/// Clipping, 2002; Newell's normal after Sutherland et al. 1974.
bool triangulate_polygon(std::span<const dvec3> corners, std::vector<uvec3>& triangles);

}  // namespace hybridrt
