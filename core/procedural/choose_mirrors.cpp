#include "core/procedural/choose_mirrors.h"

#include <algorithm>
#include <cmath>

#include "core/base/fixed_random.h"

namespace hybridrt {

std::vector<char> choose_mirrors(int components, double percent) {
  int mirrors = static_cast<int>(std::lround(percent * components / 100));
  if (percent > 0) mirrors = std::clamp(mirrors, 1, components);
  const std::vector<uint32_t> order = shuffled(static_cast<uint32_t>(components));
  std::vector<char> is_mirror(components, 0);
  for (int rank = 0; rank < mirrors; ++rank) is_mirror[order[rank]] = 1;
  return is_mirror;
}

}  // namespace hybridrt
