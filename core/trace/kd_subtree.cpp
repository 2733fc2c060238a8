#include "core/trace/kd_subtree.h"

#include <algorithm>

#include "core/trace/kd_clip.h"

namespace hybridrt {
namespace {

constexpr double kDivisionBytes = 2 * sizeof(KdNode);

// The heuristic looks one step ahead, and would leave a bundle of long diagonal triangles in one leaf: the first plane
// gains nothing, but lets the second cut off empty corners. So large cells are split against its advice, a few times on
// the way to a leaf. Source of the idea: Pharr, Jakob, Humphreys, "Physically Based Rendering", 2016, section 4.4 ("bad
// refines").
constexpr int kMaxGainless = 4;
constexpr size_t kWorthInsisting = 64;  // references

KdSplit middle_of_longest_side(const Aabb& box) {
  const vec3 extent = box.extent();
  const int axis = extent.x >= extent.y && extent.x >= extent.z ? 0 : extent.y >= extent.z ? 1 : 2;
  return {box.center()[axis], axis, true, 0};
}

class SubtreeBuilder {
 public:
  SubtreeBuilder(const KdBuildInput& input, std::vector<KdReference> refs) : input_(input), stack_(std::move(refs)) {}

  KdSubtree build(const KdCell& root) {
    out_.nodes.resize(2, KdNode::leaf(0, 0));
    divide(0, root, 0);
    return std::move(out_);
  }

 private:
  /// The cell's references are those on the stack from `begin` on; they are removed.
  void divide(uint32_t node, const KdCell& cell, size_t begin) {
    const std::span<const KdReference> refs(stack_.data() + begin, stack_.size() - begin);
    auto division = divide_cell(input_, cell, refs, nullptr);
    if (!division || !split_references(cell, refs, *division)) return make_leaf(node, refs, begin);

    stack_.resize(begin);
    stack_.insert(stack_.end(), lefts_.begin(), lefts_.end());
    const size_t right_begin = stack_.size();
    stack_.insert(stack_.end(), rights_.begin(), rights_.end());

    const uint32_t child = static_cast<uint32_t>(out_.nodes.size());
    out_.nodes[node] = KdNode::inner(division->split.axis, division->split.position, child);
    out_.nodes.resize(child + 2, KdNode::leaf(0, 0));
    divide(child + 1, division->right, right_begin);
    divide(child, division->left, begin);
  }

  bool split_references(const KdCell& cell, std::span<const KdReference> refs, KdDivision& division) {
    lefts_.clear();
    rights_.clear();
    for (const KdReference& ref : refs)
      split_reference(
          input_.scene, input_.clip_margin, ref, division.split, division.left.box, division.right.box,
          [&](const KdReference& half) { lefts_.push_back(half); },
          [&](const KdReference& half) { rights_.push_back(half); });
    return share_budget(cell, refs.size(), lefts_.size(), rights_.size(), division);
  }

  void make_leaf(uint32_t node, std::span<const KdReference> refs, size_t begin) {
    out_.nodes[node] = KdNode::leaf(static_cast<uint32_t>(out_.triangles.size()), static_cast<uint32_t>(refs.size()));
    for (const KdReference& ref : refs) out_.triangles.push_back(ref.triangle);
    stack_.resize(begin);
  }

  const KdBuildInput& input_;
  std::vector<KdReference> stack_, lefts_, rights_;
  KdSubtree out_;
};

}  // namespace

std::optional<KdDivision> divide_cell(const KdBuildInput& input, const KdCell& cell, std::span<const KdReference> refs,
                                      ThreadPool* pool) {
  if (refs.empty() || cell.depth >= input.max_depth || cell.budget_bytes < kDivisionBytes) return {};
  auto split = find_kd_split(refs, cell.box, pool);
  int gainless = cell.gainless;
  if (!split || split->cost >= kd_leaf_cost(refs.size())) {
    if (refs.size() < kWorthInsisting || ++gainless > kMaxGainless) return {};
    split = middle_of_longest_side(cell.box);
  }
  const KdCell child{cell.box, cell.depth + 1, gainless};
  KdDivision division{*split, child, child};
  division.left.box.hi[split->axis] = division.right.box.lo[split->axis] = split->position;
  return division;
}

bool share_budget(const KdCell& cell, size_t refs, size_t left_refs, size_t right_refs, KdDivision& division) {
  const double sum = static_cast<double>(left_refs + right_refs), added = sum - static_cast<double>(refs);
  const double rest = cell.budget_bytes - kDivisionBytes - sizeof(uint32_t) * added;
  if (rest < 0) return false;
  division.left.budget_bytes = sum > 0 ? rest * (static_cast<double>(left_refs) / sum) : 0;
  division.right.budget_bytes = rest - division.left.budget_bytes;
  return true;
}

KdSubtree build_kd_subtree(const KdBuildInput& input, const KdCell& cell, std::vector<KdReference> refs) {
  return SubtreeBuilder(input, std::move(refs)).build(cell);
}

}  // namespace hybridrt
