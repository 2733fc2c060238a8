#pragma once

#include <cstdint>
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

/// Which of `components` become mirrors at `percent` (0 to 100): at least one above 0, chosen by a fixed shuffle,
/// nested: a mirror stays one at a higher percentage.
std::vector<char> choose_mirrors(int components, double percent);

}  // namespace hybridrt
