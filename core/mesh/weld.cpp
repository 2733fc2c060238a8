#include "core/mesh/weld.h"

#include <atomic>
#include <bit>

#include "core/base/check.h"

namespace hybridrt {
namespace {

constexpr uint32_t kEmpty = 0xFFFFFFFFu;
constexpr size_t kGrain = 1 << 15;

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

std::vector<uint32_t> weld_positions(std::span<const vec3> positions, ThreadPool& pool) {
  HRT_CHECK(positions.size() < (size_t{1} << 31));
  // Open addressing with linear probing, load factor at most 1/2. A slot once taken keeps its position, and the index
  // in it only decreases, so threads can fill the table concurrently.
  const size_t slots = std::bit_ceil(2 * positions.size() + 1);
  std::vector<uint32_t> table(slots, kEmpty);
  std::vector<uint32_t> representative(positions.size());  // the slot, until all are in
  parallel_for(pool, positions.size(), kGrain, [&](size_t begin, size_t end) {
    for (size_t i = begin; i < end; ++i) {
      const auto own = static_cast<uint32_t>(i);
      for (size_t slot = hash_of(positions[i]) & (slots - 1);; slot = (slot + 1) & (slots - 1)) {
        std::atomic_ref<uint32_t> entry(table[slot]);
        uint32_t holder = entry.load(std::memory_order_relaxed);
        if (holder == kEmpty && entry.compare_exchange_strong(holder, own, std::memory_order_relaxed)) holder = own;
        if (positions[holder] != positions[i]) continue;
        while (own < holder && !entry.compare_exchange_weak(holder, own, std::memory_order_relaxed)) {
        }
        representative[i] = static_cast<uint32_t>(slot);
        break;
      }
    }
  });
  parallel_for(pool, positions.size(), kGrain, [&](size_t begin, size_t end) {
    for (size_t i = begin; i < end; ++i) representative[i] = table[representative[i]];
  });
  return representative;
}

}  // namespace hybridrt
