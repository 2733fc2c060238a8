#pragma once

#include <algorithm>
#include <bit>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "core/raster/bins.h"
#include "core/raster/clusters.h"

namespace hybridrt {

/// What a tile holds.
struct TileItems {
  std::span<const BinItem> items;
  std::span<const uint32_t> order;  ///< indices into `items`, the nearest first
};

/// Sorts the items of a tile. Their order only saves work, so 22 bits of the depth are enough for many.
class DepthOrder {
 public:
  /// Indices into `items`; valid until the next call.
  std::span<const uint32_t> nearest_first(std::span<const BinItem> items) {
    keys_.resize(items.size());
    // The bits of positive floats are in their order.
    for (size_t i = 0; i < items.size(); ++i) keys_[i] = uint64_t{~std::bit_cast<uint32_t>(items[i].nearest)} << 32 | i;
    if (keys_.size() < kFew)
      std::sort(keys_.begin(), keys_.end());
    else
      sort_by_digit(kLowDigit), sort_by_digit(kHighDigit);
    indices_.resize(keys_.size());
    std::transform(keys_.begin(), keys_.end(), indices_.begin(),
                   [](uint64_t key) { return static_cast<uint32_t>(key); });
    return indices_;
  }

 private:
  static constexpr size_t kFew = 300;
  static constexpr int kLowDigit = 41, kHighDigit = 52;  ///< first bits of two digits of 11 bits; bit 63 is always set

  void sort_by_digit(int digit) {
    constexpr size_t kDigits = 2048;
    sorted_.resize(keys_.size());
    uint32_t first[kDigits] = {};
    for (const uint64_t key : keys_) ++first[key >> digit & (kDigits - 1)];
    uint32_t sum = 0;
    for (uint32_t& count : first) sum += std::exchange(count, sum);
    for (const uint64_t key : keys_) sorted_[first[key >> digit & (kDigits - 1)]++] = key;
    keys_.swap(sorted_);
  }

  std::vector<uint64_t> keys_, sorted_;
  std::vector<uint32_t> indices_;
};

/// Fetches what prefetch() will read.
inline void prefetch_head(const Clusters& clusters, const BinItem& item) {
  if (item.worker < 0) __builtin_prefetch(&clusters.clusters[item.index]);
}

/// Fetches what drawing an item will read.
inline void prefetch(const Clusters& clusters, const BinItem& item) {
  if (item.worker >= 0) return;
  const Cluster& cluster = clusters.clusters[item.index];
  const char* const begin = reinterpret_cast<const char*>(clusters.offsets(cluster));
  const char* const end = reinterpret_cast<const char*>(clusters.triangles(cluster) + cluster.triangle_count);
  for (const char* line = begin; line < end; line += 64) __builtin_prefetch(line);
}

}  // namespace hybridrt
