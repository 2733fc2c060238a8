#include "core/scene/weld.h"

#include <bit>

#include "core/base/check.h"

namespace hybridrt {
namespace {

constexpr uint32_t kEmpty = 0xFFFFFFFFu;

uint64_t hash_of(const vec3& p) {
  uint64_t hash = 0;
  for (int axis = 0; axis < 3; ++axis) {
    hash ^= std::bit_cast<uint32_t>(p[axis] + 0.f);  // + 0 turns -0 into 0
    hash *= 0x9E3779B97F4A7C15ull;                   // the golden ratio: Fibonacci hashing, Knuth vol. 3
    hash ^= hash >> 29;
  }
  return hash;
}

}  // namespace

std::vector<uint32_t> weld_positions(std::span<const vec3> positions) {
  HRT_CHECK(positions.size() < (size_t{1} << 31));
  // Open addressing with linear probing, at most half full.
  const size_t slots = std::bit_ceil(2 * positions.size() + 1);
  std::vector<uint32_t> table(slots, kEmpty);
  std::vector<uint32_t> representative(positions.size());
  for (size_t i = 0; i < positions.size(); ++i) {
    size_t slot = hash_of(positions[i]) & (slots - 1);
    while (table[slot] != kEmpty && positions[table[slot]] != positions[i]) slot = (slot + 1) & (slots - 1);
    if (table[slot] == kEmpty) table[slot] = static_cast<uint32_t>(i);
    representative[i] = table[slot];
  }
  return representative;
}

}  // namespace hybridrt
