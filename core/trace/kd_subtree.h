#pragma once

#include <optional>
#include <span>
#include <vector>

#include "core/base/math.h"
#include "core/scene/scene.h"
#include "core/trace/kd_split.h"
#include "core/trace/kd_tree.h"

namespace hybridrt {

/// A cell of the kd-tree that is being built.
struct KdCell {
  Aabb box;
  int depth = 0;
  int gainless = 0;         ///< divisions above it that were made against the heuristic's advice
  double budget_bytes = 0;  ///< left for the nodes and duplicate references below this cell
};

/// What is the same all over the tree.
struct KdBuildInput {
  const Scene& scene;
  double clip_margin;  ///< scene units; bounds the rounding of clipped corners
  int max_depth;
};

struct KdDivision {
  KdSplit split;
  KdCell left, right;  ///< budgets are filled by share_budget
};

/// The plane worth dividing the cell by, or nothing: then it becomes a leaf. `pool` may be null.
std::optional<KdDivision> divide_cell(const KdBuildInput& input, const KdCell& cell, std::span<const KdReference> refs,
                                      ThreadPool* pool);

/// Deducts the cost of a division, now that its references are known, from the cell's budget and divides the rest in
/// proportion to the references. False if the budget does not suffice.
bool share_budget(const KdCell& cell, size_t refs, size_t left_refs, size_t right_refs, KdDivision& division);

/// A part of the tree built by one thread: laid out as in KdTree, but leaves hold the scene's indices.
struct KdSubtree {
  std::vector<KdNode> nodes;
  std::vector<uint32_t> triangles;
};
KdSubtree build_kd_subtree(const KdBuildInput& input, const KdCell& cell, std::vector<KdReference> refs);

}  // namespace hybridrt
