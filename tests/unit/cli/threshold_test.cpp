#include "cli/stability/threshold.h"

#include <cmath>
#include <gtest/gtest.h>
#include <vector>

namespace hybridrt::cli {
namespace {

TEST(Threshold, IsFoundWithinFivePercent) {
  const std::vector<double> falling = {1, 0.1, 0.01, 0.001}, rising = {1, 10, 100, 1000};
  for (double edge = 0.0011; edge < 1; edge *= 1.37) {
    const Threshold found = find_threshold(falling, Between::ratios, [&](double value) { return value < edge; });
    ASSERT_TRUE(found.holds_to && found.fails_from);
    EXPECT_GE(*found.holds_to, edge);
    EXPECT_LT(*found.fails_from, edge);
    EXPECT_LT(*found.holds_to / *found.fails_from, 1.05);
  }
  for (double edge = 1.1; edge < 1000; edge *= 1.37) {
    const Threshold found = find_threshold(rising, Between::ratios, [&](double value) { return value > edge; });
    ASSERT_TRUE(found.holds_to && found.fails_from);
    EXPECT_LE(*found.holds_to, edge);
    EXPECT_GT(*found.fails_from, edge);
  }
}

TEST(Threshold, WorksOnNegativeValues) {
  const std::vector<double> values = {-0.3, -0.01, -1e-5};
  const Threshold found = find_threshold(values, Between::ratios, [](double value) { return value > -0.002; });
  EXPECT_NEAR(*found.holds_to, -0.002, 1e-4);
  EXPECT_NEAR(*found.fails_from, -0.002, 1e-4);
}

TEST(Threshold, WholeNumbersBecomeNeighbours) {
  const std::vector<double> values = {64, 16, 1};
  for (int edge = 2; edge <= 64; ++edge) {
    const Threshold found = find_threshold(values, Between::whole, [&](double value) {
      EXPECT_EQ(value, std::floor(value));
      return value < edge;
    });
    EXPECT_EQ(found.holds_to, edge);
    EXPECT_EQ(found.fails_from, edge - 1);
  }
}

TEST(Threshold, SaysWhereNothingOrAllFails) {
  const std::vector<double> values = {3, 2, 1};
  Threshold found = find_threshold(values, Between::ratios, [](double) { return false; });
  EXPECT_EQ(found.holds_to, 1);
  EXPECT_FALSE(found.fails_from);
  found = find_threshold(values, Between::ratios, [](double) { return true; });
  EXPECT_FALSE(found.holds_to);
  EXPECT_EQ(found.fails_from, 3);
}

TEST(Threshold, DoesNotHalveTowardZeroOrListedValues) {
  const std::vector<double> to_zero = {1, 0.1, 0};
  Threshold found = find_threshold(to_zero, Between::ratios, [](double value) { return value == 0; });
  EXPECT_EQ(found.holds_to, 0.1);
  EXPECT_EQ(found.fails_from, 0);
  const std::vector<double> odd = {9, 5, 1};
  found = find_threshold(odd, Between::none, [](double value) { return value < 4; });
  EXPECT_EQ(found.holds_to, 5);
  EXPECT_EQ(found.fails_from, 1);
}

/// What fails in between and recovers is found at its first failure.
TEST(Threshold, StopsAtTheFirstFailure) {
  const std::vector<double> values = {1, 10, 100, 1000};
  const Threshold found = find_threshold(values, Between::ratios, [](double value) { return value > 8 && value < 12; });
  EXPECT_NEAR(*found.fails_from, 8, 0.4);
}

}  // namespace
}  // namespace hybridrt::cli
