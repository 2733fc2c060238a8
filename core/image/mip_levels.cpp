#include "core/image/mip_levels.h"

#include <algorithm>
#include <array>
#include <vector>

#include "core/base/check.h"
#include "core/image/srgb.h"

namespace hybridrt {
namespace {

/// Colour times weight, and the weight.
struct Sum {
  float red = 0, green = 0, blue = 0, weight = 0;
  void add(const Sum& more, float share) {
    red += share * more.red, green += share * more.green;
    blue += share * more.blue, weight += share * more.weight;
  }
};

constexpr float kLeastWeight = 0.25f;  // as in shaders/texture.glsl

class Decoder {
 public:
  Decoder() {
    for (int code = 0; code < 256; ++code) linear_[code] = static_cast<float>(linear_from_srgb(code / 255.0));
  }
  Sum operator()(uint32_t texel) const {
    const float weight = static_cast<float>(texel >> 24) + kLeastWeight;
    return {weight * linear_[texel & 255], weight * linear_[texel >> 8 & 255], weight * linear_[texel >> 16 & 255],
            weight};
  }

 private:
  std::array<float, 256> linear_;
};

uint32_t encoded(const Sum& sum) {
  const auto code = [&](float part) { return uint32_t{srgb8_from_linear(part / sum.weight)}; };
  const float alpha = std::clamp(sum.weight - kLeastWeight + 0.5f, 0.0f, 255.0f);
  return code(sum.red) | code(sum.green) << 8 | code(sum.blue) << 16 | static_cast<uint32_t>(alpha) << 24;
}

/// Which part of the finer rows or columns a coarser texel covers.
struct Taps {
  int first = 0, count = 0;
  float shares[4] = {};
};

Taps taps_of(int i, int coarse, int fine) {
  const double scale = static_cast<double>(fine) / coarse, begin = i * scale, end = (i + 1) * scale;
  Taps taps;
  taps.first = static_cast<int>(begin);
  for (int k = taps.first; k < fine && k < end && taps.count < 4; ++k)
    taps.shares[taps.count++] = static_cast<float>((std::min(end, k + 1.0) - std::max(begin, double(k))) / scale);
  return taps;
}

/// `fetch(x, y)` gives the finer level.
template <typename Fetch>
std::vector<Sum> halved(int width, int height, const Fetch& fetch) {
  const int coarse_width = std::max(width / 2, 1), coarse_height = std::max(height / 2, 1);
  std::vector<Taps> columns;
  for (int x = 0; x < coarse_width; ++x) columns.push_back(taps_of(x, coarse_width, width));
  std::vector<Sum> coarse(static_cast<size_t>(coarse_width) * coarse_height);
  for (int y = 0; y < coarse_height; ++y) {
    const Taps rows = taps_of(y, coarse_height, height);
    for (int x = 0; x < coarse_width; ++x) {
      Sum& sum = coarse[static_cast<size_t>(y) * coarse_width + x];
      for (int j = 0; j < rows.count; ++j)
        for (int i = 0; i < columns[x].count; ++i)
          sum.add(fetch(columns[x].first + i, rows.first + j), rows.shares[j] * columns[x].shares[i]);
    }
  }
  return coarse;
}

}  // namespace

int fill_mip_levels(std::span<uint32_t> texels, int width, int height) {
  HRT_CHECK(texels.size() == mip_texel_count(width, height));
  if (width == 1 && height == 1) return 1;
  static const Decoder decode;
  size_t filled = static_cast<size_t>(width) * static_cast<size_t>(height);
  const auto fetch_image = [&, row = width](int x, int y) { return decode(texels[static_cast<size_t>(y) * row + x]); };
  std::vector<Sum> level = halved(width, height, fetch_image);
  for (int levels = 2;; ++levels) {
    width = std::max(width / 2, 1), height = std::max(height / 2, 1);
    for (const Sum& sum : level) texels[filled++] = encoded(sum);
    if (width == 1 && height == 1) return levels;
    level = halved(width, height, [&](int x, int y) { return level[static_cast<size_t>(y) * width + x]; });
  }
}

uint64_t mip_texel_count(int width, int height) {
  uint64_t count = static_cast<uint64_t>(width) * static_cast<uint64_t>(height);
  while (width > 1 || height > 1) {
    width = std::max(width / 2, 1), height = std::max(height / 2, 1);
    count += static_cast<uint64_t>(width) * static_cast<uint64_t>(height);
  }
  return count;
}

}  // namespace hybridrt
