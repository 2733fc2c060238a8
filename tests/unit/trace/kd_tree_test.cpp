#include "core/trace/kd_tree.h"

#include <cstring>
#include <gtest/gtest.h>

#include "core/trace/coincident.h"
#include "core/trace/triangle.h"
#include "tests/support/trace_scenes.h"

namespace hybridrt {
namespace {

/// Numbers that tell how good a tree is.
struct KdTreeShape {
  size_t inner_nodes = 0, leaves = 0, empty_leaves = 0, references = 0, largest_leaf = 0;
  int depth = 0;
};

KdTreeShape measure_shape(const KdTree& tree) {
  KdTreeShape shape;
  std::vector<std::pair<uint32_t, int>> stack{{0, 0}};
  while (!stack.empty()) {
    const auto [index, depth] = stack.back();
    const KdNode node = tree.nodes[index];
    stack.pop_back();
    shape.depth = std::max(shape.depth, depth);
    if (node.is_leaf()) {
      ++shape.leaves;
      shape.empty_leaves += node.count() == 0;
      shape.references += node.count();
      shape.largest_leaf = std::max<size_t>(shape.largest_leaf, node.count());
    } else {
      ++shape.inner_nodes;
      stack.push_back({node.left_child(), depth + 1});
      stack.push_back({node.left_child() + 1, depth + 1});
    }
  }
  return shape;
}

template <typename T>
void expect_same_bytes(const std::vector<T>& a, const std::vector<T>& b) {
  ASSERT_EQ(a.size(), b.size());
  EXPECT_TRUE(a.empty() || std::memcmp(a.data(), b.data(), a.size() * sizeof(T)) == 0);
}

KdTree build(const Scene& scene, int threads = 1) {
  ThreadPool pool(threads);
  return build_kd_tree(scene, pool);
}

size_t hittable_triangles(const Scene& scene) {
  size_t count = 0;
  for (uint32_t i = 0; i < scene.triangle_count(); ++i)
    count += !is_degenerate(scene.vertex(i, 0), scene.vertex(i, 1), scene.vertex(i, 2));
  return count;
}

/// Hidden ones (coincident.h) are left out too.
size_t kept_triangles(const Scene& scene) { return hittable_triangles(scene) - find_coincident(scene).hidden.size(); }

/// Calls visit(leaf, cell) for every leaf; checks the links on the way.
template <typename Visit>
void for_each_leaf(const KdTree& tree, uint32_t node, const Aabb& cell, const Visit& visit) {
  ASSERT_LT(node, tree.nodes.size());
  const KdNode n = tree.nodes[node];
  if (n.is_leaf()) return visit(n, cell);
  ASSERT_GT(n.left_child(), node);
  ASSERT_EQ(n.left_child() % 2, 0u);
  ASSERT_GE(n.split, cell.lo[n.axis()]);
  ASSERT_LE(n.split, cell.hi[n.axis()]);
  Aabb left = cell, right = cell;
  left.hi[n.axis()] = right.lo[n.axis()] = n.split;
  for_each_leaf(tree, n.left_child(), left, visit);
  for_each_leaf(tree, n.left_child() + 1, right, visit);
}

class KdTreeBuild : public testing::TestWithParam<NamedScene> {};

TEST_P(KdTreeBuild, IsTheSameForAnyNumberOfThreads) {
  const KdTree one = build(GetParam().scene, 1);
  for (const int threads : {2, 5}) {
    const KdTree many = build(GetParam().scene, threads);
    expect_same_bytes(one.nodes, many.nodes);
    expect_same_bytes(one.leaf_triangles, many.leaf_triangles);
    expect_same_bytes(one.triangles, many.triangles);
  }
}

TEST_P(KdTreeBuild, HoldsEveryHittableTriangleWhereItIs) {
  const Scene& scene = GetParam().scene;
  const KdTree tree = build(scene);
  ASSERT_EQ(tree.triangles.size(), kept_triangles(scene));
  Random random(1);
  // Any point of a triangle lies in a leaf that lists the triangle, up to rounding of the point.
  std::vector<Aabb> reach(tree.triangles.size() * 8);
  for_each_leaf(tree, 0, tree.bounds, [&](const KdNode& leaf, const Aabb& cell) {
    for (uint32_t i = 0; i < leaf.count(); ++i) {
      const KdTriangle& triangle = tree.triangles[tree.leaf_triangles[leaf.first + i]];
      for (const vec3& corner : {triangle.a, triangle.b, triangle.c})
        if (glm::all(glm::greaterThanEqual(corner, cell.lo)) && glm::all(glm::lessThanEqual(corner, cell.hi)))
          reach[tree.leaf_triangles[leaf.first + i]].grow(corner);
    }
  });
  for (size_t i = 0; i < tree.triangles.size(); ++i) {
    const KdTriangle& triangle = tree.triangles[i];
    const vec3* const corners[] = {&triangle.a, &triangle.b, &triangle.c};
    EXPECT_EQ(*corners[3 - triangle.second - triangle.third], scene.vertex(triangle.id, 0));
    EXPECT_EQ(*corners[triangle.second], scene.vertex(triangle.id, 1));
    EXPECT_EQ(*corners[triangle.third], scene.vertex(triangle.id, 2));
    Aabb box;
    for (const vec3& corner : {triangle.a, triangle.b, triangle.c}) box.grow(corner);
    EXPECT_EQ(reach[i].lo, box.lo);
    EXPECT_EQ(reach[i].hi, box.hi);
  }
}

TEST_P(KdTreeBuild, KeepsWithinItsBounds) {
  const KdTree tree = build(GetParam().scene);
  const KdTreeShape shape = measure_shape(tree);
  EXPECT_LE(shape.depth, kKdMaxDepth);
  EXPECT_EQ(shape.references, tree.leaf_triangles.size());
  EXPECT_LE(memory_bytes(tree), 120 * tree.triangles.size() + sizeof(KdTree) + 16);
}

INSTANTIATE_TEST_SUITE_P(Scenes, KdTreeBuild, testing::ValuesIn(all_test_scenes()), test_name);

// Large enough for every parallel part of the build.
TEST(KdTree, LargeTreeIsTheSameForAnyNumberOfThreads) {
  const Scene scene = random_soup(11, 100000, 0.01f);
  const KdTree one = build(scene, 1);
  for (const int threads : {2, 5}) {
    const KdTree many = build(scene, threads);
    expect_same_bytes(one.nodes, many.nodes);
    expect_same_bytes(one.leaf_triangles, many.leaf_triangles);
    expect_same_bytes(one.triangles, many.triangles);
  }
}

TEST(KdTree, MemoryStaysBoundedWhereCutsDoNotHelp) {
  Random random(12);
  Scene needles = slivers(12, 20000), bundle, equal;
  for (int i = 0; i < 3000; ++i) {
    const vec3 start = random.in_cube(0, 0.2f);
    add_triangle(bundle, start, start + vec3(1), start + vec3(1.001f, 1, 1));
  }
  for (int i = 0; i < 10000; ++i) add_triangle(equal, vec3(0, 0, 0), vec3(1, 0.5f, 0), vec3(0, 1, 1));
  for (const Scene& scene : {needles, bundle, equal})
    EXPECT_LE(memory_bytes(build(scene)), 120 * scene.triangle_count());
}

// Along a diagonal the first split never pays by itself.
TEST(KdTree, DiagonalNeedlesAreDivided) {
  Scene scene;
  for (int i = 0; i < 1000; ++i) {
    const vec3 start(0.001f * static_cast<float>(i), 0, 0);
    add_triangle(scene, start, start + vec3(1), start + vec3(1.0001f, 1, 1));
  }
  EXPECT_LT(measure_shape(build(scene)).largest_leaf, scene.triangle_count());
}

TEST(KdTree, SmallTrianglesEndInSmallLeaves) {
  const KdTreeShape shape = measure_shape(build(closed_sphere(128, 64)));
  EXPECT_LE(shape.largest_leaf, 128u);  // 128 triangles meet at each pole
  EXPECT_LE(shape.references, 4 * 128 * 62 * 2u);
}

TEST(KdTree, OnlyDegenerateTrianglesMakeAnEmptyTree) {
  Scene scene;
  add_triangle(scene, vec3(1), vec3(1), vec3(1));
  add_triangle(scene, vec3(0), vec3(1), vec3(2));
  const KdTree tree = build(scene);
  EXPECT_TRUE(tree.triangles.empty());
  EXPECT_TRUE(tree.bounds.empty());
  EXPECT_TRUE(tree.nodes[0].is_leaf());
}

}  // namespace
}  // namespace hybridrt
