#include "core/image/contact_sheet.h"

#include <algorithm>
#include <cmath>

#include "core/base/check.h"

namespace hybridrt {
namespace {

constexpr int kGapPx = 4;
constexpr float kBackground = 0.02f;  // linear: a dark grey on which black frames still show

/// One axis of the box: which source pixels a result pixel covers, and how much of each.
struct Coverage {
  int first = 0;
  std::vector<float> weights;  ///< add up to 1
};

std::vector<Coverage> coverage(int from, int to) {
  std::vector<Coverage> result(to);
  const double step = static_cast<double>(from) / to;
  for (int i = 0; i < to; ++i) {
    const double lo = i * step, hi = (i + 1) * step;
    Coverage& cover = result[i];
    cover.first = std::min(from - 1, static_cast<int>(lo));
    for (int s = cover.first; s < from && s < hi; ++s) {
      const double overlap = std::min<double>(hi, s + 1) - std::max<double>(lo, s);
      cover.weights.push_back(static_cast<float>(std::max(0.0, overlap) / step));
    }
  }
  return result;
}

}  // namespace

Image box_filtered(const Image& image, int width_px, int height_px) {
  HRT_CHECK(image.width_px > 0 && image.height_px > 0 && width_px > 0 && height_px > 0);
  const std::vector<Coverage> columns = coverage(image.width_px, width_px);
  const std::vector<Coverage> rows = coverage(image.height_px, height_px);
  Image result(width_px, height_px, image.channels);
  for (int y = 0; y < height_px; ++y)
    for (size_t j = 0; j < rows[y].weights.size(); ++j)
      for (int x = 0; x < width_px; ++x)
        for (size_t i = 0; i < columns[x].weights.size(); ++i) {
          const float* source =
              image.pixel(columns[x].first + static_cast<int>(i), rows[y].first + static_cast<int>(j));
          const float weight = rows[y].weights[j] * columns[x].weights[i];
          for (int c = 0; c < image.channels; ++c) result.pixel(x, y)[c] += weight * source[c];
        }
  return result;
}

Image contact_sheet(std::span<const Image> images, int columns, int cell_width_px) {
  HRT_CHECK(columns >= 1 && cell_width_px >= 1);
  if (images.empty()) return {};

  std::vector<Image> thumbnails;
  int cell_height_px = 1;
  for (const Image& image : images) {
    HRT_CHECK(image.width_px > 0 && image.channels > 0);
    const double height = static_cast<double>(cell_width_px) * image.height_px / image.width_px;
    thumbnails.push_back(box_filtered(image, cell_width_px, std::max(1, static_cast<int>(std::lround(height)))));
    cell_height_px = std::max(cell_height_px, thumbnails.back().height_px);
  }

  const int count = static_cast<int>(images.size());
  columns = std::min(columns, count);
  const int rows = (count + columns - 1) / columns;
  Image sheet(columns * (cell_width_px + kGapPx) + kGapPx, rows * (cell_height_px + kGapPx) + kGapPx, 3, kBackground);
  for (int i = 0; i < count; ++i) {
    const Image& thumbnail = thumbnails[i];
    const int left = kGapPx + i % columns * (cell_width_px + kGapPx);
    const int top = kGapPx + i / columns * (cell_height_px + kGapPx);
    for (int y = 0; y < thumbnail.height_px; ++y)
      for (int x = 0; x < thumbnail.width_px; ++x)
        for (int c = 0; c < 3; ++c)
          sheet.pixel(left + x, top + y)[c] = thumbnail.pixel(x, y)[thumbnail.channels >= 3 ? c : 0];
  }
  return sheet;
}

}  // namespace hybridrt
