#pragma once

#include <array>
#include <cstdint>

namespace hybridrt {

/// For each set of up to eight lanes, bit i for lane i: their numbers in order, then zeros.
inline constexpr auto kChosenLanes = [] {
  std::array<std::array<uint8_t, 8>, 256> table{};
  for (unsigned bits = 0; bits < 256; ++bits)
    for (unsigned lane = 0, count = 0; lane < 8; ++lane)
      if (bits >> lane & 1) table[bits][count++] = static_cast<uint8_t>(lane);
  return table;
}();

}  // namespace hybridrt
