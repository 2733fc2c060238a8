#include "cli/stability/threshold.h"

#include <cmath>

namespace hybridrt::cli {
namespace {

constexpr double kCloseEnough = 1.05;

/// A value to try between two; nothing if they are close enough.
std::optional<double> between_them(double a, double b, Between between) {
  if (between == Between::none) return std::nullopt;
  if (between == Between::whole) {
    const double middle = std::floor((a + b) / 2);
    return std::abs(a - b) > 1 ? std::optional(middle) : std::nullopt;
  }
  if (!(a * b > 0) || std::max(a / b, b / a) < kCloseEnough) return std::nullopt;
  return std::copysign(std::sqrt(a * b), a);
}

}  // namespace

Threshold find_threshold(std::span<const double> values, Between between, const std::function<bool(double)>& fails) {
  Threshold threshold;
  for (const double value : values) {
    if (fails(value)) {
      threshold.fails_from = value;
      break;
    }
    threshold.holds_to = value;
  }
  if (!threshold.holds_to || !threshold.fails_from) return threshold;
  while (const std::optional<double> middle = between_them(*threshold.holds_to, *threshold.fails_from, between))
    (fails(*middle) ? threshold.fails_from : threshold.holds_to) = *middle;
  return threshold;
}

}  // namespace hybridrt::cli
