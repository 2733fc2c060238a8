#include "core/golden/golden.h"

#include <algorithm>
#include <fmt/format.h>

#include "core/base/error.h"

namespace hybridrt {

std::string golden_picture_name(const GoldenCase& golden, int frame, bool has_several) {
  return has_several ? fmt::format("{}.{:04}", golden.name, frame) : golden.name;
}

void keep_cases(GoldenList& list, std::span<const std::string> names) {
  std::string unknown;
  for (const std::string& name : names)
    if (std::ranges::none_of(list.cases, [&](const GoldenCase& c) { return c.name == name; }))
      unknown += fmt::format("{}'{}'", unknown.empty() ? "" : ", ", name);
  if (!unknown.empty()) throw error(ErrorKind::usage, "there is no golden case {} in {}", unknown, list.file.string());
  if (names.empty()) return;
  std::erase_if(list.cases,
                [&](const GoldenCase& golden) { return std::ranges::find(names, golden.name) == names.end(); });
}

std::string GoldenResult::verdict() const {
  if (!failure.empty()) return failure;
  std::string text = compared.reason;
  if (compared.measured) {
    const std::string numbers = fmt::format("max error {:.4f}, {:.3f} % of the pixels over {}", compared.max_error,
                                            compared.percent_over_fail(), limits.fail);
    text = compared.same ? numbers : compared.reason + " (" + numbers + ")";
  }
  if (time.is_over())
    text += fmt::format("; it took {:.1f} times the calibration, its budget is {:g}", time.calibrations, *time.budget);
  return text;
}

}  // namespace hybridrt
