// What a cell of the light buffer knows about a triangle, checked at points of the triangle.

#include "core/trace/light_cells.h"

#include <gtest/gtest.h>
#include <set>

#include "tests/support/trace_scenes.h"

namespace hybridrt {
namespace {

constexpr int kCells = 4096;  // the most cells, where rounding matters most
constexpr double kRounding = 0x1p-40;

struct Numbers : Random {
  using Random::Random;
  double magnitude(double lo, double hi) { return lo * std::pow(hi / lo, double(unit())); }
  double sign() { return below(2) ? 1 : -1; }
  /// `p`, moved by the rounding of light space and grid coordinates.
  dvec3 rounded(const dvec3& p) { return p + kRounding * dvec3(between(-1, 1), between(-1, 1), 0); }
};

/// Calls body(point of the triangle, its place in cell (i, j), i, j) for points in the grid.
template <typename Body>
void for_points_of(const dvec3 (&corners)[3], Numbers& random, int points, const Body& body) {
  for (int n = 0; n < points; ++n) {
    const double u = n == 0 ? 0 : n == 1 ? 1 : random.unit(), v = n < 2 ? 0 : (1 - u) * random.unit();
    const dvec3 p = random.rounded(corners[0] + u * (corners[1] - corners[0]) + v * (corners[2] - corners[0]));
    const int i = static_cast<int>(std::floor(p.x / 2)), j = static_cast<int>(std::floor(p.y / 2));
    if (i >= 0 && j >= 0 && i < kCells && j < kCells) body(p, dvec2(p.x - (2 * i + 1), p.y - (2 * j + 1)), i, j);
  }
}

/// In units.
float lane(const LightEntry& entry, int lane, const dvec2& at) {
  return entry.a[lane] * static_cast<float>(at.x) + entry.b[lane] * static_cast<float>(at.y) + entry.c[lane];
}

TEST(LightCells, BoundTheDepthsOfTinySteepTriangles) {
  Numbers random(1);
  int points = 0, outside = 0, misjudged = 0;
  for (int n = 0; n < 200000; ++n) {
    const double length = random.magnitude(1e-5, 1), width = length * random.magnitude(1e-6, 1);
    const double turn = 2 * kPi * random.unit();
    const dvec3 along(std::cos(turn), std::sin(turn), 0), across(-along.y, along.x, 0);
    const auto depth = [&] { return dvec3(0, 0, random.sign() * random.magnitude(1e-6, 0.5)); };
    // On or near the corner of a cell, so that the plane decides its bounds there.
    const double off = n % 2 ? random.magnitude(1e-9, 1e-2) : 0;
    const dvec3 near(random.sign() * off, random.sign() * off, 0);
    dvec3 corners[3];
    corners[0] = dvec3(2.0 * random.below(kCells), 2.0 * random.below(kCells), 0) + near + depth();
    corners[1] = corners[0] + length * along + depth();
    corners[2] = corners[0] + length * random.unit() * along + width * across + depth();
    const GridTriangle triangle(corners[0], corners[1], corners[2]);
    for_points_of(corners, random, 6, [&](const dvec3& p, const dvec2& at, int i, int j) {
      const CellView view(triangle, i, j);
      const LightEntry entry = view.entry(0, /*holes=*/false);
      ++points;
      outside += p.z < view.nearest() || p.z > view.farthest();
      const float units = entry.units_per_depth(), below = (static_cast<float>(p.z) - entry.nearest) * units;
      outside += entry.nearest > view.nearest();
      misjudged += std::abs(lane(entry, 3, at) + below) > LightEntry::kPlaneError + LightEntry::kDepthError * units;
    });
  }
  EXPECT_GT(points, 300000);
  EXPECT_EQ(outside, 0);
  EXPECT_EQ(misjudged, 0);
}

TEST(LightCells, ListSliversWhereverTheyGo) {
  Numbers random(2);
  int points = 0, unlisted = 0, beside = 0;
  for (int n = 0; n < 2000; ++n) {
    const auto in_grid = [&] { return 2.0 * kCells * dvec3(random.unit(), random.unit(), 0); };
    const dvec3 from = in_grid(), to = in_grid();
    const dvec3 across = glm::normalize(dvec3(from.y - to.y, to.x - from.x, 0));
    const dvec3 corners[3] = {
        from, to,
        from + random.magnitude(1e-9, 1) * (to - from) + (n % 3 ? random.magnitude(1e-14, 1e-3) : 0) * across};
    const GridTriangle triangle(random.rounded(corners[0]), random.rounded(corners[1]), random.rounded(corners[2]));
    std::set<std::pair<int, int>> listed;
    for_each_cell(triangle, kCells, kCells, [&](int i, int j) { listed.insert({i, j}); });
    for_points_of(corners, random, 20, [&](const dvec3&, const dvec2& at, int i, int j) {
      const LightEntry entry = CellView(triangle, i, j).entry(0, /*holes=*/false);
      ++points;
      unlisted += !listed.contains({i, j});
      for (int edge = 0; edge < 3; ++edge) beside += lane(entry, edge, at) < -LightEntry::kEdgeError;
    });
    ASSERT_LT(listed.size(), 5u * kCells) << "only those along it";
  }
  EXPECT_GT(points, 30000);
  EXPECT_EQ(unlisted, 0);
  EXPECT_EQ(beside, 0) << "certainly outside an edge, although on the triangle";
}

}  // namespace
}  // namespace hybridrt
