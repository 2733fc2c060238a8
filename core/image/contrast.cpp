#include "core/image/contrast.h"

#include <algorithm>
#include <cmath>

#include "core/base/check.h"

namespace hybridrt {
namespace {

float root(float value) { return std::sqrt(std::max(value, 0.0f)); }

/// Three rows' square roots, all channels of a pixel side by side.
struct RootRows {
  std::vector<float> above, row, below;
};

}  // namespace

bool contrasts(std::span<const float> a, std::span<const float> b, float threshold) {
  bool found = false;
  for (size_t c = 0; c < a.size(); ++c) found |= std::abs(root(a[c]) - root(b[c])) > threshold;
  return found;
}

void mark_contrasts(const Image& picture, float threshold, ThreadPool& pool, std::span<uint8_t> marks) {
  HRT_CHECK_EQ(marks.size(), picture.pixel_count());
  const size_t channels = picture.channels, size = picture.width_px * channels;
  constexpr size_t kRowsAtOnce = 32;
  parallel_for(pool, picture.height_px, kRowsAtOnce, [&](size_t begin, size_t end) {
    // A row's neighbours beyond the picture are itself.
    RootRows roots{std::vector<float>(size), std::vector<float>(size), std::vector<float>(size)};
    std::vector<float> contrast(size);
    const auto take_roots = [&](size_t y, std::vector<float>& row) {
      std::transform(&picture.data[y * size], &picture.data[y * size] + size, row.begin(), root);
    };
    take_roots(begin > 0 ? begin - 1 : 0, roots.above);
    take_roots(begin, roots.row);
    for (size_t y = begin; y < end; ++y) {
      take_roots(std::min<size_t>(y + 1, picture.height_px - 1), roots.below);
      for (size_t i = 0; i < size; ++i) {
        const float here = roots.row[i];
        const float left = roots.row[i < channels ? i : i - channels];
        const float right = roots.row[i + channels < size ? i + channels : i];
        contrast[i] = std::max({std::abs(here - roots.above[i]), std::abs(here - roots.below[i]), std::abs(here - left),
                                std::abs(here - right)});
      }
      for (size_t x = 0; x < static_cast<size_t>(picture.width_px); ++x) {
        float most = 0;
        for (size_t c = 0; c < channels; ++c) most = std::max(most, contrast[x * channels + c]);
        marks[y * picture.width_px + x] = most > threshold;
      }
      roots.above.swap(roots.row);
      roots.row.swap(roots.below);
    }
  });
}

}  // namespace hybridrt
