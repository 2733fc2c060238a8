#pragma once

#include "core/golden/golden.h"

namespace hybridrt {

/// A page that needs nothing but the folder that it lies in: failures first, expected and actual picture under a
/// slider, their difference. `program`: its name and version. Pictures of `results` must lie beside the page.
std::string golden_html(std::span<const GoldenResult> results, const std::string& program);

/// The results as JUnit XML, for CI servers: a broken case is an error, another picture a failure.
std::string golden_junit(std::span<const GoldenResult> results);

}  // namespace hybridrt
