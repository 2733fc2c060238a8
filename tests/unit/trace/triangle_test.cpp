#include "core/trace/triangle.h"

#include <gtest/gtest.h>

#include "tests/support/trace_scenes.h"

namespace hybridrt {
namespace {

template <typename Real>
bool hits(const vec3& origin, const vec3& dir, const vec3& a, const vec3& b, const vec3& c, TriangleHit<Real>& hit) {
  return intersect_triangle(shear_ray(Vec3<Real>(origin), Vec3<Real>(dir)), a, b, c, hit);
}

template <typename Real>
bool hits(const vec3& origin, const vec3& dir, const vec3& a, const vec3& b, const vec3& c) {
  TriangleHit<Real> hit;
  return hits(origin, dir, a, b, c, hit);
}

TEST(Triangle, GivesDistanceAndWeightsFromBothSides) {
  const vec3 a(0, 0, 2), b(4, 0, 2), c(0, 4, 2);
  TriangleHit<float> hit;
  ASSERT_TRUE(hits<float>(vec3(1, 2, 0), vec3(0, 0, 0.5f), a, b, c, hit));
  EXPECT_EQ(hit.t, 4);
  EXPECT_EQ(hit.u, 0.25f);
  EXPECT_EQ(hit.v, 0.5f);
  ASSERT_TRUE(hits<float>(vec3(1, 2, 5), vec3(0, 0, -1), a, b, c, hit));
  EXPECT_EQ(hit.t, 3);
  EXPECT_EQ(hit.v, 0.5f);
  ASSERT_TRUE(hits<float>(vec3(1, 2, 5), vec3(0, 0, 1), a, b, c, hit));  // behind: left to the caller
  EXPECT_EQ(hit.t, -3);
  EXPECT_FALSE(hits<float>(vec3(3, 2, 0), vec3(0, 0, 1), a, b, c));
}

TEST(Triangle, EdgesAndCornersBelongToIt) {
  const vec3 a(0, 0, 2), b(4, 0, 2), c(0, 4, 2);
  for (const vec3& on : {a, b, c, vec3(2, 0, 2), vec3(0, 1, 2), vec3(1, 3, 2)}) {
    EXPECT_TRUE(hits<float>(vec3(on.x, on.y, 0), vec3(0, 0, 1), a, b, c));
    EXPECT_TRUE(hits<double>(vec3(on.x, on.y, 0), vec3(0, 0, 1), a, b, c));
  }
}

TEST(Triangle, IsNotSeenEdgeOn) {
  EXPECT_FALSE(hits<float>(vec3(0, 0, -1), vec3(0, 0, 1), vec3(0, 0, 0), vec3(0, 0, 1), vec3(0, 1, 0)));
  EXPECT_FALSE(hits<double>(vec3(0, 0, -1), vec3(0, 0, 1), vec3(0, 0, 0), vec3(0, 0, 1), vec3(0, 1, 0)));
}

// The edge passes the ray at 2^-26 of its length, where products of floats round to a tie.
TEST(Triangle, TellsTheSideOfAnEdgeWhereFloatsCannot) {
  const float e = 0x1p-13f;
  const vec3 b(1, 1 - e, 1), c(-1 - e, -1, 1);  // sheared products: (1 + e)(1 - e) against 1
  for (const vec3& a : {vec3(-1, 1, 1), vec3(1, -1, 1)}) {
    TriangleHit<double> truth;
    const bool truly = hits<double>(vec3(0), vec3(0, 0, 1), a, b, c, truth);
    EXPECT_EQ(hits<float>(vec3(0), vec3(0, 0, 1), a, b, c), truly);
    EXPECT_EQ(truly, a.x < 0);
  }
}

TEST(Triangle, SurvivesUnderflowAndOverflow) {
  for (const float scale : {1e-25f, 1e-19f, 1e12f, 1e19f, 1e25f}) {
    const vec3 a = scale * vec3(-1, -1, 2), b = scale * vec3(3, -1, 2), c = scale * vec3(-1, 3, 2);
    TriangleHit<float> hit;
    ASSERT_TRUE(hits<float>(vec3(0), vec3(0, 0, 1), a, b, c, hit)) << scale;
    EXPECT_NEAR(hit.t / scale, 2, 1e-6);
    EXPECT_NEAR(hit.u, 0.25, 1e-6);
    EXPECT_NEAR(hit.v, 0.25, 1e-6);
    EXPECT_FALSE(hits<float>(scale * vec3(2, 2, 0), vec3(0, 0, 1), a, b, c)) << scale;
  }
}

// In every order of the corners, also for rays through edges and corners and along the triangle.
TEST(Triangle, IsBesideWhereItIsNotMet) {
  Random random(9);
  int beside = 0, met = 0;
  for (int i = 0; i < 20000; ++i) {
    const bool coarse = i % 2 == 0;  // many points on edges
    const auto point = [&] {
      return coarse ? vec3(random.below(4), random.below(4), random.below(4)) : random.in_cube(-1, 1);
    };
    const vec3 a = point(), b = point(), c = point(), origin = point(),
               dir = coarse ? point() - origin : random.direction();
    if (dir == vec3(0) || is_degenerate(a, b, c)) continue;
    const ShearedRay<double> ray = shear_ray(dvec3(origin), dvec3(dir));
    const bool is_met = hits<double>(origin, dir, a, b, c);
    const bool is_edge_on = glm::dot(glm::cross(dvec3(b - a), dvec3(c - a)), dvec3(dir)) == 0;
    ASSERT_EQ(is_beside(ray, a, b, c), is_beside(ray, b, a, c));
    ASSERT_EQ(is_beside(ray, a, b, c), is_beside(ray, c, a, b));
    if (is_beside(ray, a, b, c)) {
      ASSERT_FALSE(is_met);
    } else if (!is_edge_on) {
      ASSERT_TRUE(is_met);
    }
    beside += !is_met, met += is_met;
  }
  EXPECT_GT(beside, 5000);
  EXPECT_GT(met, 500);
}

TEST(Triangle, ZeroAreaIsRecognisedExactly) {
  EXPECT_TRUE(is_degenerate(vec3(0.1f), vec3(0.1f), vec3(0.1f)));
  EXPECT_TRUE(is_degenerate(vec3(1, 2, 3), vec3(1, 2, 3), vec3(4, 5, 7)));
  EXPECT_TRUE(is_degenerate(vec3(0), vec3(0.1f, 0.3f, -7), vec3(0.2f, 0.6f, -14)));
  EXPECT_FALSE(is_degenerate(vec3(0), vec3(0.1f, 0.3f, -7), vec3(0.2f, 0.6f, std::nextafter(-14.0f, 0.0f))));
  EXPECT_FALSE(is_degenerate(vec3(0), vec3(1e-30f, 0, 0), vec3(0, 1e-30f, 0)));
}

}  // namespace
}  // namespace hybridrt
