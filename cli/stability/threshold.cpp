#include "cli/stability/threshold.h"

#include <algorithm>
#include <cmath>

namespace hybridrt::cli {
namespace {

constexpr double kCloseEnough = 1.05;

/// Whether there is no value left to try between two.
bool are_close(double a, double b, Between between) {
  switch (between) {
    case Between::none: return true;
    case Between::whole: return std::abs(a - b) <= 1;
    case Between::ratios: return !(a * b > 0) || std::max(a / b, b / a) < kCloseEnough;
  }
  return true;
}

double middle_of(double a, double b, Between between) {
  return between == Between::whole ? std::floor((a + b) / 2) : std::copysign(std::sqrt(a * b), a);
}

}  // namespace

Threshold find_threshold(std::span<const double> values, Between between, const std::function<bool(double)>& fails) {
  size_t first_failure = 0;
  while (first_failure < values.size() && !fails(values[first_failure])) ++first_failure;
  Threshold threshold;
  if (first_failure > 0) threshold.holds_to = values[first_failure - 1];
  if (first_failure < values.size()) threshold.fails_from = values[first_failure];
  if (first_failure == 0 || first_failure == values.size()) return threshold;

  double holds_to = values[first_failure - 1], fails_from = values[first_failure];
  while (!are_close(holds_to, fails_from, between)) {
    const double middle = middle_of(holds_to, fails_from, between);
    (fails(middle) ? fails_from : holds_to) = middle;
  }
  return {holds_to, fails_from};
}

}  // namespace hybridrt::cli
