#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "core/base/math.h"
#include "core/base/parallel.h"
#include "core/scene/scene.h"

namespace hybridrt {

/// Largest depth of a leaf (the root has 0); bounds the stack of a traversal.
inline constexpr int kKdMaxDepth = 62;

/// 8 bytes, after Wald, "Realtime Ray Tracing and Interactive Global Illumination", 2004, ch. 7. The low two
/// bits of `tag` hold the split axis, or 3 for a leaf. Inner node: `split` is the plane's coordinate, the
/// other bits of `tag` the index of the left child (below the plane); the right child follows it. Leaf:
/// `first` is the start of its range in KdTree::leaf_triangles, the other bits of `tag` its length.
struct KdNode {
  union {
    float split;
    uint32_t first;
  };
  uint32_t tag;

  static KdNode inner(int axis, float split, uint32_t left_child) {
    KdNode node;
    node.split = split;
    node.tag = left_child << 2 | static_cast<uint32_t>(axis);
    return node;
  }
  static KdNode leaf(uint32_t first, uint32_t count) {
    KdNode node;
    node.first = first;
    node.tag = count << 2 | 3u;
    return node;
  }
  bool is_leaf() const { return (tag & 3) == 3; }
  int axis() const { return static_cast<int>(tag & 3); }
  uint32_t left_child() const { return tag >> 2; }
  uint32_t count() const { return tag >> 2; }
};
static_assert(sizeof(KdNode) == 8);

/// The corners as in_order() sorts them, each padded to 16 bytes so that a vector load takes a whole one; `id` is the
/// triangle's index in the scene.
struct alignas(16) KdTriangle {
  vec3 a;
  uint32_t id;
  vec3 b;
  uint8_t second, third;  ///< as in OrderedTriangle
  bool turned;
  vec3 c;
  uint32_t unused;
};
static_assert(sizeof(KdTriangle) == 48);

/// A kd-tree over the triangles of one scene; only data, see build_kd_tree and make_kd_caster. Independent of the scene
/// it was built from (it holds copies of the corners, and shares the textures if they have holes). Never more than 120
/// bytes per triangle.
struct KdTree {
  Aabb bounds;                           ///< box of the triangles that can be hit; empty without any
  std::vector<KdNode> nodes;             ///< [0] is the root, [1] unused: siblings start at even indices
  std::vector<uint32_t> leaf_triangles;  ///< indices into `triangles`, a range per leaf
  std::vector<KdTriangle>
      triangles;  ///< in the order of the leaves; degenerate and hidden ones (coincident.h) are left out
  std::shared_ptr<const Textures> holes;  ///< asked at every hit; null where no triangle has holes
};

/// Surface-area heuristic (SAH) with perfect splits (triangles are clipped to the cells that they reach) and
/// a bonus for cutting off empty space: Havran, "Heuristic Ray Shooting Algorithms", 2000; Wald and Havran,
/// "On building fast kd-trees for ray tracing, and on doing that in O(N log N)", 2006. Large nodes choose
/// among the planes of a grid (binned), small ones among all the sides of their triangles' boxes (exact).
/// The result is the same, to the byte, for every size of `pool`. Throws CheckFailed where an index would
/// overflow (more than about 10^9 nodes), std::bad_alloc.
KdTree build_kd_tree(const Scene& scene, ThreadPool& pool);

/// Bytes of a finished tree, its triangle records included.
size_t memory_bytes(const KdTree& tree);

}  // namespace hybridrt
