#pragma once

#include <cstdint>
#include <numeric>
#include <utility>
#include <vector>

namespace hybridrt {

/// SplitMix64 (Steele, Lea, Flood 2014): the same numbers everywhere, unlike the standard library's
/// distributions and std::shuffle.
inline uint64_t next_random(uint64_t& state) {
  uint64_t z = state += 0x9E3779B97F4A7C15ull;
  z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9ull;
  z = (z ^ (z >> 27)) * 0x94D049BB133111EBull;
  return z ^ (z >> 31);
}

/// The next number in [0, 1).
inline double next_unit(uint64_t& state) { return static_cast<double>(next_random(state) >> 11) * 0x1p-53; }

/// The numbers from 0 to count - 1 by a Fisher-Yates shuffle with a fixed seed.
inline std::vector<uint32_t> shuffled(uint32_t count) {
  std::vector<uint32_t> order(count);
  std::iota(order.begin(), order.end(), 0u);
  uint64_t state = 2005;
  for (uint32_t i = count; i-- > 1;) std::swap(order[i], order[next_random(state) % (i + 1)]);
  return order;
}

}  // namespace hybridrt
