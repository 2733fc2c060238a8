#pragma once

#include <filesystem>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "core/image/compare.h"

namespace hybridrt {

/// One picture that must stay as it is.
struct GoldenCase {
  std::string name;                  ///< expected picture: NAME.png beside the list
  std::string scene;                 ///< path (resolved against the list) or scene:…
  std::vector<std::string> options;  ///< options of `render`
  CompareLimits limits;
  std::string reason;  ///< why these limits
};

struct GoldenList {
  std::filesystem::path folder;
  std::vector<GoldenCase> cases;

  std::filesystem::path expected(const GoldenCase& golden) const { return folder / (golden.name + ".png"); }
};

/// Throws Error(input), naming the file and the case, for what is not JSON, unknown or missing keys, and a name given
/// twice. Scene paths are resolved against the list's folder, then against the folder above it.
GoldenList read_golden_list(const std::filesystem::path& list);

/// Keeps the named cases, in the list's order; all if `names` is empty. Throws Error(usage) for a name that
/// is not in the list.
void keep_cases(GoldenList& list, std::span<const std::string> names);

/// The result of a case. Paths are empty where there is no such file.
struct GoldenResult {
  GoldenCase golden;
  CompareResult compared;
  std::string failure;  ///< why it could not be rendered or compared at all
  std::filesystem::path actual, expected, difference;
  double seconds = 0;

  bool passed() const { return failure.empty() && compared.same; }
  std::string verdict() const;  ///< one line
};

/// A page with expected, actual and difference pictures side by side. Image paths are written relative to
/// `page_folder`.
std::string golden_html(std::span<const GoldenResult> results, const std::filesystem::path& page_folder);

/// The results as JUnit XML, for CI servers.
std::string golden_junit(std::span<const GoldenResult> results);

}  // namespace hybridrt
