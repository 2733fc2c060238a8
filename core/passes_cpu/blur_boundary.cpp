#include "core/passes_cpu/blur_boundary.h"

#include <algorithm>

#include "core/base/check.h"
#include "shaders/shared.h"

namespace hybridrt {
namespace {

constexpr size_t kBand_px = 64;  ///< rows that a thread takes at a time

/// The sums of `of(x)` over the window around each x of a row.
template <typename Of>
void sum_windows(int width_px, int radius_px, const Of& of, uint8_t* sums) {
  int sum = 0;
  for (int x = 0; x < std::min(radius_px, width_px); ++x) sum += of(x);
  for (int x = 0; x < width_px; ++x) {
    if (x + radius_px < width_px) sum += of(x + radius_px);
    if (x > radius_px) sum -= of(x - radius_px - 1);
    sums[x] = static_cast<uint8_t>(sum);
  }
}

void add_row(const uint8_t* row, int sign, std::vector<int>& sums) {
  for (size_t x = 0; x < sums.size(); ++x) sums[x] += sign * row[x];
}

}  // namespace

void blur_boundary(int width_px, int kernel_px, ThreadPool& pool, BlurMemory& memory, std::span<uint8_t> mask) {
  HRT_CHECK(kernel_px > 0 && kernel_px < 256 && mask.size() % width_px == 0);
  const auto width = static_cast<size_t>(width_px), height = mask.size() / width;
  const int radius_px = kernel_px / 2;
  memory.lit.resize(mask.size()), memory.receivers.resize(mask.size());
  parallel_for(pool, height, kBand_px, [&](size_t begin, size_t end) {
    for (size_t first = begin * width; first < end * width; first += width) {
      const uint8_t* const row = &mask[first];
      sum_windows(
          width_px, radius_px, [row](int x) { return row[x] & HRT_MASK_LIT; }, &memory.lit[first]);
      sum_windows(
          width_px, radius_px, [row](int x) { return row[x] != HRT_MASK_NO_RECEIVER; }, &memory.receivers[first]);
    }
  });

  parallel_for(pool, height, kBand_px, [&](size_t begin, size_t end) {
    const auto radius = static_cast<size_t>(radius_px);
    std::vector<int> lit(width), receivers(width);
    const auto add = [&](size_t y, int sign) {
      add_row(&memory.lit[y * width], sign, lit), add_row(&memory.receivers[y * width], sign, receivers);
    };
    for (size_t y = begin - std::min(begin, radius); y < std::min(begin + radius, height); ++y) add(y, 1);
    for (size_t y = begin; y < end; ++y) {
      if (y + radius < height) add(y + radius, 1);
      if (y > begin && y > radius) add(y - radius - 1, -1);
      uint8_t* const row = &mask[y * width];
      for (size_t x = 0; x < width; ++x)
        if (row[x] != HRT_MASK_NO_RECEIVER && lit[x] > 0 && lit[x] < receivers[x]) row[x] |= HRT_MASK_MARKED;
    }
  });
}

}  // namespace hybridrt
