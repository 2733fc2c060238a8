#include "cli/tune/goal.h"

#include <cmath>
#include <fmt/format.h>

#include "core/base/error.h"
#include "core/load/text_scan.h"

namespace hybridrt::cli {

Goal parse_goal(const std::string& text) {
  static constexpr std::pair<std::string_view, Goal::Unit> kUnits[] = {
      {"dB", Goal::Unit::decibel}, {"%", Goal::Unit::percent_off}, {"wrong", Goal::Unit::wrong_pixels}};
  for (const auto& [suffix, unit] : kUnits) {
    if (!text.ends_with(suffix)) continue;
    const auto number = parse_number(std::string_view(text).substr(0, text.size() - suffix.size()));
    if (number && *number >= 0 && *number < 1e9) return {unit, *number};
  }
  throw error(ErrorKind::usage,
              "--max-error {}: write 45dB (PSNR), 0.1% (of the pixels off by more than 2/255) or 10wrong (pixels)",
              text);
}

double error_of(const Goal& goal, const Accuracy& accuracy, size_t pixels) {
  switch (goal.unit) {
    case Goal::Unit::decibel: return -accuracy.psnr_db;
    case Goal::Unit::percent_off: return 100.0 * static_cast<double>(accuracy.pixels_off) / static_cast<double>(pixels);
    case Goal::Unit::wrong_pixels:
      return static_cast<double>(accuracy.other_triangle.value_or(0) + accuracy.false_lit.value_or(0) +
                                 accuracy.false_shadow.value_or(0));
  }
  return INFINITY;
}

bool is_met(const Goal& goal, double error) {
  return error <= (goal.unit == Goal::Unit::decibel ? -goal.limit : goal.limit);
}

std::string error_text(const Goal& goal, double error) {
  switch (goal.unit) {
    case Goal::Unit::decibel: return std::isinf(error) ? "equal to the last bit" : fmt::format("{:.1f} dB", -error);
    case Goal::Unit::percent_off: return fmt::format("{:.3g} % off", error);
    case Goal::Unit::wrong_pixels: return fmt::format("{:.0f} wrong pixel{}", error, error == 1 ? "" : "s");
  }
  return "?";
}

}  // namespace hybridrt::cli
