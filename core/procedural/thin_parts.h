#pragma once

#include "core/procedural/turning.h"

namespace hybridrt {

// Closed surfaces for scene:thin.

/// Height of the ground.
double ground_height(double x, double z);

/// The ground as a slab, `cells` x `cells` on top, from -half to half.
std::vector<Patch> ground_slab(double half, int cells);

/// A box between two corners whose top rises to a `point` high pyramid.
std::vector<Patch> box(const dvec3& lo, const dvec3& hi, double point = 0);

/// A tube along a smooth path with flat ends: `sides` around, `cells` along.
std::vector<Patch> tube(std::function<dvec3(double)> path, double radius, int sides, int cells);

/// A ring standing upright around the origin, its axis along z.
std::vector<Patch> ring(double radius, double thickness, int around, int across);

/// A ball around the origin.
std::vector<Patch> ball(double radius, int around);

/// A blade of grass: a triangular stem of two joints that ends in a point, kBladeTriangles triangles, bent
/// toward `lean`. Appended to `mesh` with flat normals.
inline constexpr int kBladeTriangles = 16;
void add_blade(TriangleMesh& mesh, const dvec3& root, const dvec3& lean, double height, double width, double turn_rad);

}  // namespace hybridrt
