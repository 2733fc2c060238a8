#pragma once

#include <functional>
#include <optional>
#include <span>

namespace hybridrt::cli {

/// How values between two neighbours of a series are tried.
enum class Between {
  ratios,  ///< by their geometric mean, until they differ by less than 5 %
  whole,   ///< whole numbers, until they are neighbours
  none     ///< the series has all values that there are
};

/// Where something starts to fail along a series.
struct Threshold {
  std::optional<double> holds_to;    ///< the last value before the first failure; absent: the first one fails
  std::optional<double> fails_from;  ///< the first failure; absent: none
};

/// `values` run from harmless to severe. They are tried in order up to the first that fails; then the gap between it
/// and the one before is halved (bisection), as `between` says. Values of different signs, and 0, are not halved.
Threshold find_threshold(std::span<const double> values, Between between, const std::function<bool(double)>& fails);

}  // namespace hybridrt::cli
