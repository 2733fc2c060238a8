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
#include "core/trace/holes.h"
#include "core/trace/kd_tree.h"
#include "core/trace/triangle.h"

HWY_BEFORE_NAMESPACE();
namespace hybridrt {
namespace HWY_NAMESPACE {

/// A ray prepared for the planes of the tree. Decisions at planes err on the side of visiting too much: wherever a ray
/// passes a plane within `slack` both sides are visited. The slack covers
///  - the rounding of the distance to a plane (origins far away, almost parallel rays),
///  - the shear of the triangle test, which moves the corners by up to 3 epsilon times their distance: what
///    it then hits may lie in a cell that the exact ray misses by as much, and would leak there,
///  - in double, the rounding of clipped triangles when the tree was built.
template <typename Real>
struct PlaneRay {
  struct Axis {
    Real origin;
    Real inv_dir;              ///< finite and not zero: a component of zero counts as a tiny one
    Real slack;                ///< in units of t
  } axes[3];                   // an array: glm's vectors index by branches
  uint32_t near_is_right = 0;  ///< bit k is set where the ray goes down axis k
  Real t_near, t_far;          ///< where the ray crosses the bounds, clipped to its own range

  PlaneRay(const Aabb& bounds, const Ray<Real>& ray) : t_near(ray.t_min), t_far(ray.t_max) {
    constexpr bool kIsDouble = std::numeric_limits<Real>::digits > 24;
    constexpr Real kLargest = std::numeric_limits<Real>::max() / 4;
    const Vec3<Real> lo = Vec3<Real>(bounds.lo) - ray.origin, hi = Vec3<Real>(bounds.hi) - ray.origin;
    Real reach = largest(glm::max(glm::abs(lo), glm::abs(hi)));  // largest coordinate relative to the origin
    if (kIsDouble) reach += largest(glm::abs(ray.origin));       // clipping worked with absolute coordinates
    const Real error = reach * (kIsDouble ? Real(1e-12) : 5 * std::numeric_limits<Real>::epsilon());

    for (int k = 0; k < 3; ++k) {
      const Real inv_dir = std::copysign(std::min(1 / std::abs(ray.dir[k]), kLargest), ray.dir[k]);
      const Real slack = std::min(error * std::abs(inv_dir), kLargest);
      const Real t0 = lo[k] * inv_dir, t1 = hi[k] * inv_dir;
      t_near = std::max(t_near, std::min(t0, t1) - slack);
      t_far = std::min(t_far, std::max(t0, t1) + slack);
      axes[k] = {ray.origin[k], inv_dir, slack};
      near_is_right |= uint32_t{std::signbit(inv_dir)} << k;
    }
  }

  static Real largest(const Vec3<Real>& v) { return std::max(std::max(v.x, v.y), v.z); }
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
  uint32_t node = 0;
  Real t_near = planes.t_near, t_far = planes.t_far;
  if (!(t_near <= t_far)) return {};
  for (;;) {
    // Down to a leaf, the nearer child first.
    while (!nodes[node].is_leaf()) {
      const KdNode inner = nodes[node];
      const int k = inner.axis();
      const auto& axis = planes.axes[k];
      const Real t_plane = (Real(inner.split) - axis.origin) * axis.inv_dir;
      const Real t_before = t_plane - axis.slack, t_after = t_plane + axis.slack;
      const uint32_t near = inner.left_child() + (planes.near_is_right >> k & 1);
      const uint32_t far = near ^ 1;  // the children of a node are 2i and 2i + 1
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

    // On to the next cell that begins no later than the nearest hit.
    do {
      if (todo_count == 0) return nearest.result();
      --todo_count;
      node = todo[todo_count].node;
      t_near = todo[todo_count].t_near;
      t_far = std::min(todo[todo_count].t_far, nearest.t);
    } while (t_near > t_far);
  }
}

inline OrderedTriangle ordered(const KdTriangle& t) { return {t.a, t.b, t.c, t.second, t.third, t.turned}; }

/// One triangle after the other: the reference for every other leaf test.
template <typename Real>
class ScalarLeaf {
 public:
  ScalarLeaf(const KdTree& tree, const Ray<Real>& ray)
      : ray_(shear_ray(ray.origin, ray.dir)),
        triangles_(tree.triangles.data()),
        ids_(tree.leaf_triangles.data()),
        holes_(tree.holes.get()) {}

  template <bool kAny>
  void test(uint32_t first, uint32_t count, NearestHit<Real>& nearest) const {
    for (uint32_t i = first; i < first + count; ++i) {
      const KdTriangle& triangle = triangles_[ids_[i]];
      TriangleHit<Real> hit;
      if (!intersect_triangle(ray_, ordered(triangle), hit)) continue;
      if (holes_ && is_hole(*holes_, triangle.id, hit.u, hit.v)) continue;
      nearest.offer(hit, triangle.id);
      if (kAny && nearest.found()) return;
    }
  }

 private:
  ShearedRay<Real> ray_;
  const KdTriangle* triangles_;
  const uint32_t* ids_;
  const Textures* holes_;
};

}  // namespace HWY_NAMESPACE
}  // namespace hybridrt
HWY_AFTER_NAMESPACE();

#endif  // HYBRIDRT_KD_TRAVERSE_H
