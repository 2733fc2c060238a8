#pragma once

#include <vector>

namespace hybridrt {

/// Which of `components` become mirrors at `percent` (0 to 100): at least one above 0, chosen by a fixed shuffle,
/// nested: a mirror stays one at a higher percentage.
std::vector<char> choose_mirrors(int components, double percent);

}  // namespace hybridrt
