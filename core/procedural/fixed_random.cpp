#include "core/procedural/fixed_random.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace hybridrt {
namespace {

/// A Fisher-Yates shuffle with a fixed seed.
std::vector<int> shuffled(int count) {
  std::vector<int> order(count);
  std::iota(order.begin(), order.end(), 0);
  uint64_t state = 2005;
  for (int i = count - 1; i > 0; --i) std::swap(order[i], order[next_random(state) % (i + 1)]);
  return order;
}

}  // namespace

std::vector<char> choose_mirrors(int components, double percent) {
  int mirrors = static_cast<int>(std::lround(percent * components / 100));
  if (percent > 0) mirrors = std::clamp(mirrors, 1, components);
  const std::vector<int> order = shuffled(components);
  std::vector<char> is_mirror(components, 0);
  for (int rank = 0; rank < mirrors; ++rank) is_mirror[order[rank]] = 1;
  return is_mirror;
}

}  // namespace hybridrt
