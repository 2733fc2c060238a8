#include "core/trace/kd_tree.h"

#include <algorithm>
#include <cmath>
#include <span>
#include <utility>

#include "core/base/check.h"
#include "core/trace/coincident.h"
#include "core/trace/kd_clip.h"
#include "core/trace/kd_split.h"
#include "core/trace/kd_subtree.h"
#include "core/trace/triangle.h"

namespace hybridrt {
namespace {

// Large cells are divided one after the other, each by all threads; a cell with less than kSubtreeShare of
// the scene becomes a subtree, and the subtrees are built side by side, each by one thread. All of this
// depends on the scene only, never on the number of threads.
constexpr size_t kSubtreeShare = 128;
constexpr size_t kSubtreeMin = 4096;
constexpr size_t kSplitGrain = 1 << 14;

// For nodes and duplicate references. With its record (48 bytes) and first reference (4 bytes) a triangle never costs
// more than 116 bytes.
constexpr double kBudgetBytesPerTriangle = 64;

struct PendingSubtree {
  uint32_t node;  ///< node of the top tree that the subtree's root replaces
  KdCell cell;
  std::vector<KdReference> refs;
  KdSubtree built;
};

/// The nodes above the subtrees; leaves stand for subtrees.
struct TopTree {
  std::vector<KdNode> nodes;
  std::vector<PendingSubtree> pending;
};

std::vector<KdReference> make_references(const Scene& scene) {
  std::vector<KdReference> refs;
  refs.reserve(scene.triangle_count());
  const CoincidentTriangles coincident = find_coincident(scene);
  HiddenTriangles hidden(coincident);
  for (uint32_t triangle = 0; triangle < scene.triangle_count(); ++triangle) {
    if (hidden.holds(triangle)) continue;
    const vec3 a = scene.vertex(triangle, 0), b = scene.vertex(triangle, 1), c = scene.vertex(triangle, 2);
    if (is_degenerate(a, b, c)) continue;
    refs.push_back({{glm::min(a, glm::min(b, c)), glm::max(a, glm::max(b, c))}, triangle});
  }
  return refs;
}

struct Halves {
  std::vector<KdReference> left, right;
};

Halves split_in_parallel(const KdBuildInput& input, std::span<const KdReference> refs, const KdDivision& division,
                         ThreadPool& pool) {
  std::vector<Halves> parts((refs.size() + kSplitGrain - 1) / kSplitGrain);
  parallel_for(pool, refs.size(), kSplitGrain, [&](size_t begin, size_t end) {
    Halves& part = parts[begin / kSplitGrain];
    for (const KdReference& ref : refs.subspan(begin, end - begin))
      split_reference(
          input.scene, input.clip_margin, ref, division.split, division.left.box, division.right.box,
          [&](const KdReference& half) { part.left.push_back(half); },
          [&](const KdReference& half) { part.right.push_back(half); });
  });
  size_t left_count = 0, right_count = 0;
  for (const Halves& part : parts) left_count += part.left.size(), right_count += part.right.size();
  Halves halves;
  halves.left.reserve(left_count), halves.right.reserve(right_count);
  for (Halves& part : parts) {
    halves.left.insert(halves.left.end(), part.left.begin(), part.left.end());
    halves.right.insert(halves.right.end(), part.right.begin(), part.right.end());
    part = {};
  }
  return halves;
}

void divide_top(const KdBuildInput& input, uint32_t node, const KdCell& cell, std::vector<KdReference> refs,
                size_t subtree_size, ThreadPool& pool, TopTree& top) {
  if (refs.size() > subtree_size) {
    if (auto division = divide_cell(input, cell, refs, &pool)) {
      Halves halves = split_in_parallel(input, refs, *division, pool);
      if (share_budget(cell, refs.size(), halves.left.size(), halves.right.size(), *division)) {
        std::vector<KdReference>().swap(refs);
        const uint32_t child = static_cast<uint32_t>(top.nodes.size());
        top.nodes[node] = KdNode::inner(division->split.axis, division->split.position, child);
        top.nodes.resize(child + 2, KdNode::leaf(0, 0));
        divide_top(input, child, division->left, std::move(halves.left), subtree_size, pool, top);
        divide_top(input, child + 1, division->right, std::move(halves.right), subtree_size, pool, top);
        return;
      }
    }
  }
  top.pending.push_back({node, cell, std::move(refs), {}});
}

/// Appends a subtree after the existing nodes and leaves; its root replaces `node`.
void graft(KdSubtree subtree, uint32_t node, KdTree& tree) {
  const size_t node_offset = tree.nodes.size() - 2, leaf_offset = tree.leaf_triangles.size();
  HRT_CHECK(node_offset + subtree.nodes.size() < (1u << 30));
  HRT_CHECK(leaf_offset + subtree.triangles.size() < kNoTriangle);
  const auto moved = [&](KdNode n) {
    return n.is_leaf() ? KdNode::leaf(static_cast<uint32_t>(n.first + leaf_offset), n.count())
                       : KdNode::inner(n.axis(), n.split, static_cast<uint32_t>(n.left_child() + node_offset));
  };
  tree.nodes[node] = moved(subtree.nodes[0]);
  for (size_t i = 2; i < subtree.nodes.size(); ++i) tree.nodes.push_back(moved(subtree.nodes[i]));
  tree.leaf_triangles.insert(tree.leaf_triangles.end(), subtree.triangles.begin(), subtree.triangles.end());
}

/// Copies the triangles in the order in which the leaves name them first, so that a leaf's triangles lie
/// close together, and lets the leaves name the copies.
void gather_triangles(const Scene& scene, size_t count, KdTree& tree) {
  std::vector<uint32_t> record_of(scene.triangle_count(), kNoTriangle);
  tree.triangles.reserve(count);
  for (uint32_t& triangle : tree.leaf_triangles) {
    uint32_t& record = record_of[triangle];
    if (record == kNoTriangle) {
      record = static_cast<uint32_t>(tree.triangles.size());
      const OrderedTriangle t =
          in_order(scene.vertex(triangle, 0), scene.vertex(triangle, 1), scene.vertex(triangle, 2));
      tree.triangles.push_back({t.a, triangle, t.b, t.second, t.third, t.turned, t.c, 0});
    }
    triangle = record;
  }
}

}  // namespace

KdTree build_kd_tree(const Scene& scene, ThreadPool& pool) {
  HRT_CHECK(scene.triangle_count() < (1u << 30));
  std::vector<KdReference> refs = make_references(scene);
  const size_t triangle_count = refs.size();
  KdTree tree;
  if (scene.has_holes()) tree.holes = scene.textures;
  for (const KdReference& ref : refs) tree.bounds.grow(ref.box);

  const vec3 size = tree.bounds.empty() ? vec3(0) : glm::max(glm::abs(tree.bounds.lo), glm::abs(tree.bounds.hi));
  const KdBuildInput input{scene, 1e-13 * std::max({size.x, size.y, size.z}),
                           std::min(kKdMaxDepth, 10 + static_cast<int>(2 * std::log2(triangle_count + 1.0)))};
  const KdCell root{tree.bounds, 0, 0,
                    kBudgetBytesPerTriangle * static_cast<double>(triangle_count) - 2 * sizeof(KdNode)};
  TopTree top{std::vector<KdNode>(2, KdNode::leaf(0, 0)), {}};
  divide_top(input, 0, root, std::move(refs), std::max(kSubtreeMin, triangle_count / kSubtreeShare), pool, top);

  pool.run(top.pending.size(), [&](size_t i, int) {
    PendingSubtree& subtree = top.pending[i];
    subtree.built = build_kd_subtree(input, subtree.cell, std::move(subtree.refs));
  });

  size_t node_count = top.nodes.size(), reference_count = 0;
  for (const PendingSubtree& subtree : top.pending) {
    node_count += subtree.built.nodes.size() - 2;
    reference_count += subtree.built.triangles.size();
  }
  tree.nodes = std::move(top.nodes);
  tree.nodes.reserve(node_count);
  tree.leaf_triangles.reserve(reference_count);
  for (PendingSubtree& subtree : top.pending) graft(std::exchange(subtree.built, {}), subtree.node, tree);
  gather_triangles(scene, triangle_count, tree);
  return tree;
}

size_t memory_bytes(const KdTree& tree) {
  return sizeof(KdTree) + tree.nodes.capacity() * sizeof(KdNode) + tree.leaf_triangles.capacity() * sizeof(uint32_t) +
         tree.triangles.capacity() * sizeof(KdTriangle);
}

}  // namespace hybridrt
