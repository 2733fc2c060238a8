#pragma once

#include <memory>

#include "core/scene/scene.h"

namespace hybridrt {

/// Where a surface is nearest to a point.
struct ClosestPoint {
  uint32_t triangle = kNoTriangle;  ///< none: the scene has no triangle
  double distance = 0;              ///< scene units
};

/// Answers which triangle of a scene is nearest to a point, by Embree's point queries. Immutable after construction,
/// safe to call from many threads at once. The scene must outlive it.
class ClosestPoints {
 public:
  /// The build uses up to `threads` >= 1 threads. Throws Error (device) with Embree's own message, std::bad_alloc.
  ClosestPoints(const Scene& scene, int threads);
  ~ClosestPoints();

  /// `point` in scene space; holes count as surface. The distance is computed in double; a triangle that is nearer by
  /// less than the rounding of float coordinates may be missed. `likely`: a distance to look within first.
  ClosestPoint nearest(const dvec3& point, double likely) const;

 private:
  struct Tree;
  std::unique_ptr<Tree> tree_;
};

}  // namespace hybridrt
