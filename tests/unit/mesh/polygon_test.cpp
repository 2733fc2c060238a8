#include "core/mesh/polygon.h"

#include <gtest/gtest.h>
#include <random>

namespace hybridrt {
namespace {

double doubled_area(const std::vector<dvec3>& p, const uvec3& t, const dvec3& up) {
  return glm::dot(glm::cross(p[t.y] - p[t.x], p[t.z] - p[t.x]), up);
}

/// Cuts the polygon and checks that the triangles tile it: n - 2 of them, none facing away, the same area.
void expect_tiled(const std::vector<dvec3>& p, bool flat_ones_allowed = false) {
  dvec3 normal(0);
  for (size_t i = 1; i + 1 < p.size(); ++i) normal += glm::cross(p[i] - p[0], p[i + 1] - p[0]);
  const double area = glm::length(normal);
  std::vector<uvec3> triangles;
  EXPECT_TRUE(triangulate_polygon(p, triangles));
  ASSERT_EQ(triangles.size(), p.size() - 2);
  double sum = 0;
  for (const uvec3& t : triangles) {
    const double part = doubled_area(p, t, normal / area);
    EXPECT_GE(part, flat_ones_allowed ? -1e-9 * area : 1e-12 * area);
    sum += part;
  }
  EXPECT_NEAR(sum, area, 1e-9 * area);
}

/// Star-shaped around its middle, every corner at a random distance: very concave.
std::vector<dvec3> random_star(int corners, dvec3 middle, dvec3 u, dvec3 v, uint32_t seed) {
  std::mt19937 random(seed);
  std::vector<dvec3> p;
  for (int i = 0; i < corners; ++i) {
    const double angle_rad = 2 * kPi * i / corners, radius = 0.1 + random() % 1000 / 1000.0;
    p.push_back(middle + radius * (std::cos(angle_rad) * u + std::sin(angle_rad) * v));
  }
  return p;
}

TEST(Polygon, ConvexAndConcaveQuads) {
  expect_tiled({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}});
  std::vector<dvec3> dart = {{0, 0, 0}, {4, -2, 0}, {1, 0, 0}, {4, 2, 0}};  // concave at its third corner
  for (int turn = 0; turn < 4; ++turn) {
    expect_tiled(dart);
    std::rotate(dart.begin(), dart.begin() + 1, dart.end());
  }
  std::vector<dvec3> straight = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {1, 0.1, 0}};  // a straight second corner
  for (int turn = 0; turn < 4; ++turn) {
    expect_tiled(straight);
    std::rotate(straight.begin(), straight.begin() + 1, straight.end());
  }
}

TEST(Polygon, ConcaveOnesAnywhereInSpace) {
  for (uint32_t seed = 0; seed < 60; ++seed) {
    const dvec3 u = glm::normalize(dvec3(1, 0.1 * seed, -0.7)),
                v = glm::normalize(glm::cross(u, dvec3(0.3, 1, 0.02 * seed)));
    expect_tiled(random_star(5 + seed * seed, {0, 0, 0}, u, v, seed));
    expect_tiled(random_star(5 + seed, {8432, -6092, 71}, u, v, seed));
  }
}

TEST(Polygon, StraightCornersAndAHoleOnABridge) {
  std::vector<dvec3> box;  // each side in 10 pieces
  for (int i = 0; i < 10; ++i) box.emplace_back(i, 0, 0);
  for (int i = 0; i < 10; ++i) box.emplace_back(10, i, 0);
  for (int i = 10; i > 0; --i) box.emplace_back(i, 10, 0);
  for (int i = 10; i > 0; --i) box.emplace_back(0, i, 0);
  expect_tiled(box);
  expect_tiled(
      {{0, 0, 0}, {9, 0, 0}, {9, 9, 0}, {0, 9, 0}, {0, 0, 0}, {3, 3, 0}, {3, 6, 0}, {6, 6, 0}, {6, 3, 0}, {3, 3, 0}},
      /*flat_ones_allowed=*/true);
}

TEST(Polygon, RoundOnesAreNoFans) {
  std::vector<dvec3> p = random_star(1000, dvec3(0), {1, 0, 0}, {0, 1, 0}, 1);
  for (dvec3& corner : p) corner = glm::normalize(corner);
  std::vector<uvec3> triangles;
  ASSERT_TRUE(triangulate_polygon(p, triangles));
  std::vector<int> uses(p.size());
  for (const uvec3& t : triangles) ++uses[t.x], ++uses[t.y], ++uses[t.z];
  EXPECT_LT(*std::max_element(uses.begin(), uses.end()), 50);
}

TEST(Polygon, OnesThatCrossThemselvesStillGiveAllTriangles) {
  std::mt19937 random(3);
  for (int corners : {5, 6, 50, 3000}) {
    std::vector<dvec3> p;
    for (int i = 0; i < corners; ++i) p.emplace_back(random() % 1000, random() % 1000, 0);
    std::vector<uvec3> triangles;
    triangulate_polygon(p, triangles);
    EXPECT_EQ(triangles.size(), p.size() - 2);
  }
  std::vector<uvec3> triangles;
  EXPECT_FALSE(triangulate_polygon(std::vector<dvec3>(7, dvec3(1)), triangles));
  EXPECT_EQ(triangles.size(), 5u);
}

}  // namespace
}  // namespace hybridrt
