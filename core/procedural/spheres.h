#pragma once

#include <cstdint>
#include <vector>

#include "core/scene/scene.h"
#include "core/scene/scene_shot.h"

namespace hybridrt {

/// A field of balls on a square ground, to measure cost against the number of triangles and the share of
/// mirrors. After Beck et al. 2005, figure 5.
struct SpheresOptions {
  int64_t triangles = 500'000;     ///< aimed at, kFewestTriangles to kMostTriangles; met within 2 %
  double reflective_percent = 10;  ///< share of the balls, 0 to 100; above 0 at least one ball

  static constexpr int64_t kFewestTriangles = 100, kMostTriangles = 20'000'000;
};

/// What make_spheres() will build.
struct SpheresPlan {
  int side = 0;                    ///< side * side balls
  int rings = 0, segments = 0;     ///< per ball, from pole to pole and around
  int ground_x = 0, ground_z = 0;  ///< cells of the ground, two triangles each
  std::vector<char> is_mirror;     ///< per ball. Nested: a mirror stays one at a higher percentage

  int balls() const { return side * side; }
  int64_t ball_triangles() const { return int64_t{2} * segments * (rings - 1); }
  int64_t triangles() const { return balls() * ball_triangles() + int64_t{2} * ground_x * ground_z; }
};

/// A pure function: same options, same plan.
SpheresPlan plan_spheres(const SpheresOptions& options);

/// Unit spacing, y up, the ground at y = 0 with its middle at the origin; balls hover 2 % of their diameter above it,
/// so that they do not touch it. First the ground, then the balls row by row. Balls are closed meshes with outward
/// winding and exact normals, which all balls share. Materials: ground and five matt colours, each also as a mirror
/// (illum 3, Ks 0.5); only those that are used.
Scene make_spheres(const SpheresOptions& options);

/// The default orbit and light.
inline SceneShot spheres_shot() { return {}; }

}  // namespace hybridrt
