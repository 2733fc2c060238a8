// Compiled once for every vector instruction set that includes it, hence the toggle instead of a
// #pragma once (see "foreach_target" in Highway's documentation).
#if defined(HYBRIDRT_KD_TRAVERSE_H) == defined(HWY_TARGET_TOGGLE)
#ifdef HYBRIDRT_KD_TRAVERSE_H
#undef HYBRIDRT_KD_TRAVERSE_H
#else
#define HYBRIDRT_KD_TRAVERSE_H
#endif

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <hwy/highway.h>
#include <limits>

#include "core/base/math.h"
#include "core/trace/kd_tree.h"
#include "core/trace/triangle.h"

HWY_BEFORE_NAMESPACE();
namespace hybridrt {
namespace HWY_NAMESPACE {

/// A ray as the planes of the tree see it. Decisions at planes err on the side of visiting too much:
/// wherever a ray passes a plane within `slack` both sides are visited. The slack covers
///  - the rounding of the distance to a plane (origins far away, almost parallel rays),
///  - the shear of the triangle test, which moves the corners by up to 3 epsilon times their distance: what
///    it then hits may lie in a cell that the exact ray misses by as much, and would leak there,
///  - in double, the rounding of clipped triangles when the tree was built.
template <typename Real>
struct PlaneRay {
  Vec3<Real> origin;
  Vec3<Real> inv_dir;  ///< finite and not zero: components near zero are replaced by tiny ones
  Vec3<Real> slack;    ///< in units of t, for planes across each axis
  Real t_near, t_far;  ///< where the ray crosses the bounds, cut to its own range

  PlaneRay(const Aabb& bounds, const Ray<Real>& ray)
      : origin(ray.origin), t_near(ray.t_min), t_far(ray.t_max) {
    constexpr Real kEpsilon = std::numeric_limits<Real>::epsilon();
    constexpr Real kLargest = std::numeric_limits<Real>::max() / 4;
    const Vec3<Real> lo = Vec3<Real>(bounds.lo) - origin, hi = Vec3<Real>(bounds.hi) - origin;
    Real reach = 0;  // no coordinate relative to the origin is larger
    for (int axis = 0; axis < 3; ++axis)
      reach = std::max(reach, std::max(std::abs(lo[axis]), std::abs(hi[axis])));
    if constexpr (std::numeric_limits<Real>::digits > 24)  // clipping worked with absolute coordinates
      reach += std::max(std::max(std::abs(origin.x), std::abs(origin.y)), std::abs(origin.z));
    const Real error = std::numeric_limits<Real>::digits > 24 ? reach * Real(1e-12) : reach * 5 * kEpsilon;

    const Real largest = std::max(std::max(std::abs(ray.dir.x), std::abs(ray.dir.y)), std::abs(ray.dir.z));
    for (int axis = 0; axis < 3; ++axis) {
      const Real d = std::max(std::abs(ray.dir[axis]), largest * Real(1e-20));
      inv_dir[axis] = std::min(1 / d, kLargest) * std::copysign(Real(1), ray.dir[axis]);
      slack[axis] = std::min(error * std::abs(inv_dir[axis]), kLargest);
      const Real t0 = lo[axis] * inv_dir[axis], t1 = hi[axis] * inv_dir[axis];
      t_near = std::max(t_near, std::min(t0, t1) - slack[axis]);
      t_far = std::min(t_far, std::max(t0, t1) + slack[axis]);
    }
  }
};

/// Closest hit, or with kAny the first one met. `Leaf` tests a leaf's triangles:
///   Leaf(const KdTree&, const Ray<Real>&);
///   void test<kAny>(uint32_t first, uint32_t count, NearestHit<Real>&) const;  // kAny: may stop at a hit
/// Stackful front-to-back order. Source: Havran, "Heuristic Ray Shooting Algorithms", 2000, TA_B^rec.
template <bool kAny, typename Leaf, typename Real>
Hit<Real> traverse(const KdTree& tree, const Ray<Real>& ray) {
  if (tree.triangles.empty() || !is_traceable(ray.origin, ray.dir)) return {};
  const PlaneRay<Real> planes(tree.bounds, ray);
  const Leaf leaf(tree, ray);
  NearestHit<Real> nearest(ray.t_min, ray.t_max);

  struct Todo {
    uint32_t node;
    Real t_near, t_far;
  } todo[kKdMaxDepth + 1];
  int todo_count = 0;

  const KdNode* const nodes = tree.nodes.data();
  const uint32_t near_is_right[3] = {std::signbit(planes.inv_dir.x), std::signbit(planes.inv_dir.y),
                                     std::signbit(planes.inv_dir.z)};
  uint32_t node = 0;
  Real t_near = planes.t_near, t_far = planes.t_far;
  if (!(t_near <= t_far)) return {};
  for (;;) {
    // Down to a leaf, the nearer child first.
    while (!nodes[node].is_leaf()) {
      const int axis = nodes[node].axis();
      const Real t_plane = (Real(nodes[node].split) - planes.origin[axis]) * planes.inv_dir[axis];
      const uint32_t left = nodes[node].left_child();
      const uint32_t near = left + near_is_right[axis], far = left + (near_is_right[axis] ^ 1);
      const Real t_before = t_plane - planes.slack[axis], t_after = t_plane + planes.slack[axis];
      if (t_before > t_far) {
        node = near;
      } else if (t_after < t_near) {
        node = far;
      } else {
        todo[todo_count++] = {far, std::max(t_near, t_before), t_far};
        node = near;
        t_far = std::min(t_far, t_after);
      }
    }

    if (const uint32_t count = nodes[node].count(); count > 0) {
      leaf.template test<kAny>(nodes[node].first, count, nearest);
      if (kAny && nearest.found()) return nearest.result();
    }

    // The next cell that begins no later than the nearest hit.
    do {
      if (todo_count == 0) return nearest.result();
      --todo_count;
      node = todo[todo_count].node;
      t_near = todo[todo_count].t_near;
      t_far = std::min(todo[todo_count].t_far, nearest.t);
    } while (t_near > t_far);
  }
}

/// One triangle after the other: the reference for every other leaf test.
template <typename Real>
class ScalarLeaf {
 public:
  ScalarLeaf(const KdTree& tree, const Ray<Real>& ray)
      : ray_(shear_ray(ray.origin, ray.dir)),
        triangles_(tree.triangles.data()),
        ids_(tree.leaf_triangles.data()) {}

  template <bool kAny>
  void test(uint32_t first, uint32_t count, NearestHit<Real>& nearest) const {
    for (uint32_t i = first; i < first + count; ++i) {
      const KdTriangle& triangle = triangles_[ids_[i]];
      TriangleHit<Real> hit;
      if (!intersect_triangle(ray_, triangle.v0, triangle.v1, triangle.v2, hit)) continue;
      nearest.offer(hit, triangle.id);
      if (kAny && nearest.found()) return;
    }
  }

 private:
  ShearedRay<Real> ray_;
  const KdTriangle* triangles_;
  const uint32_t* ids_;
};

}  // namespace HWY_NAMESPACE
}  // namespace hybridrt
HWY_AFTER_NAMESPACE();

#endif  // HYBRIDRT_KD_TRAVERSE_H
