#pragma once

#include <functional>

#include "core/procedural/patch_mesh.h"

namespace hybridrt {

/// A solid as a function: below 0 inside, above 0 outside, near the surface about the distance to it (slope between 1/2
/// and 2).
using Solid = std::function<double(const dvec3&)>;

/// The surface of `solid` inside the box `lo`..`hi` (which must hold all of it), closed whatever the shape, in
/// triangles with edges of about `edge`. Normals are the function's gradient, or the triangle's own where the two
/// disagree (a detail finer than `edge`).
///
/// Marching tetrahedra (Doi and Koide 1991) on the body-centred cubic lattice, whose tetrahedra are nearly
/// regular, then vertices slide along the surface toward their neighbours' middle and back onto it.
TriangleMesh carve(const Solid& solid, const dvec3& lo, const dvec3& hi, double edge);

// Solids to carve from. Distances are exact or close below.
double smooth_union(double a, double b, double blend);  ///< rounds the seam over about `blend`
double smooth_cut(double a, double b, double blend);    ///< a without b
double ellipsoid(const dvec3& p, const dvec3& center, const dvec3& radii);
/// A cone with round ends from `a`, of radius `radius_a`, to `b`.
double round_cone(const dvec3& p, const dvec3& a, const dvec3& b, double radius_a, double radius_b);

}  // namespace hybridrt
