#pragma once

#include <cstdint>
#include <optional>
#include <span>

#include "core/base/math.h"
#include "core/base/parallel.h"

namespace hybridrt {

/// One triangle's part of one cell while the kd-tree is built: `box` bounds the triangle clipped to the cell.
struct KdReference {
  Aabb box;
  uint32_t triangle;
};

/// A plane that divides a cell. References that lie in the plane go to one side as a whole.
struct KdSplit {
  float position;
  int axis;
  bool planar_left;
  float cost;  ///< expected cost of the divided cell, in the unit of kd_leaf_cost
};

/// Expected cost of a leaf, in the unit "one step down the tree". Leaves are tested four at a time.
float kd_leaf_cost(size_t references);

/// The cheapest plane for a cell `box` with `refs`, by the surface-area heuristic, or nothing where there is
/// no plane to choose. `pool` may be null (then serial); the answer does not depend on it.
std::optional<KdSplit> find_kd_split(std::span<const KdReference> refs, const Aabb& box, ThreadPool* pool);

/// Whether `ref` lies below the plane, above it or on both sides.
enum class KdSide { left, right, both };
inline KdSide side_of(const KdReference& ref, const KdSplit& split) {
  const float lo = ref.box.lo[split.axis], hi = ref.box.hi[split.axis];
  if (lo == split.position && hi == split.position) return split.planar_left ? KdSide::left : KdSide::right;
  if (hi <= split.position) return KdSide::left;
  return lo >= split.position ? KdSide::right : KdSide::both;
}

}  // namespace hybridrt
