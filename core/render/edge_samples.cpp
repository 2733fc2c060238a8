#include "core/render/edge_samples.h"

#include <algorithm>
#include <atomic>
#include <mutex>
#include <tuple>

#include "core/image/contrast.h"
#include "core/raster/depth_tile.h"
#include "core/render/samples.h"

namespace hybridrt {
namespace {

constexpr PixelAt kNeighbors[] = {{-1, 0}, {1, 0}, {0, -1}, {0, 1}};

class EdgeSampler {
 public:
  EdgeSampler(Image& picture, const EdgeSampling& sampling, EdgeMemory& memory, const TakeSamples& take)
      : picture_(picture), sampling_(sampling), memory_(memory), take_(take) {}

  int64_t run() {
    // Means wait until all are taken: until then the picture has first samples only.
    std::vector<PixelAt> pixels;
    std::vector<vec4> sums;
    for (list_marked(); !memory_.pixels.empty(); list_beside()) {
      take_samples();
      pixels.insert(pixels.end(), memory_.pixels.begin(), memory_.pixels.end());
      sums.insert(sums.end(), memory_.sums.begin(), memory_.sums.end());
    }
    for (size_t i = 0; i < pixels.size(); ++i) {
      const std::span<float> pixel = first_sample(pixels[i]);
      std::copy_n(&sums[i].x, pixel.size(), pixel.begin());
      take_mean(pixel, sampling_.samples);
    }
    return static_cast<int64_t>(pixels.size());
  }

 private:
  size_t index_of(PixelAt at) const { return static_cast<size_t>(at.y) * picture_.width_px + at.x; }
  std::span<float> first_sample(PixelAt at) const {
    return {&picture_.data[index_of(at) * picture_.channels], static_cast<size_t>(picture_.channels)};
  }

  /// Lists the marked pixels, tile by tile and block by block.
  void list_marked() {
    memory_.pixels.clear();
    const int width = picture_.width_px, height = picture_.height_px;
    for (int y = 0; y < height; y += kTileHeight_px)
      for (int x = 0; x < width; x += kTileWidth_px)
        Tile{x, y, std::min(x + kTileWidth_px, width), std::min(y + kTileHeight_px, height)}.for_each_pixel_in_blocks(
            [&](int px, int py, uint32_t) {
              if (memory_.sampled[index_of({px, py})]) memory_.pixels.push_back({px, py});
            });
  }

  /// Lists those beside that samples want, in the same order.
  void list_beside() {
    memory_.pixels.swap(beside_);
    beside_.clear();
    const auto place = [](PixelAt at) {
      return std::tuple(at.y / kTileHeight_px, at.x / kTileWidth_px, at.y / Tile::kBlock_px, at.x / Tile::kBlock_px,
                        at.y, at.x);
    };
    std::ranges::sort(memory_.pixels, {}, place);
  }

  void take_samples() {
    const std::vector<PixelAt>& pixels = memory_.pixels;
    memory_.sums.assign(pixels.size(), vec4(0));
    if (!sampling_.retake_first)
      for (size_t i = 0; i < pixels.size(); ++i) std::ranges::copy(first_sample(pixels[i]), &memory_.sums[i].x);
    take_(pixels, [&](size_t first, size_t count, std::span<const vec4> colors) {
      std::vector<PixelAt> wanted;
      for (int sample = sampling_.first_taken(); sample < sampling_.samples; ++sample) {
        const dvec2 offset_px = sample_offset_px(sample);
        for (size_t i = 0; i < count; ++i) {
          memory_.sums[first + i] += colors[i];
          want_neighbors(pixels[first + i], offset_px, colors[i], wanted);
        }
        colors = colors.subspan(count);
      }
      const std::lock_guard lock(mutex_);
      beside_.insert(beside_.end(), wanted.begin(), wanted.end());
    });
  }

  void want_neighbors(PixelAt at, const dvec2& offset_px, const vec4& color, std::vector<PixelAt>& wanted) {
    for (const PixelAt& step : kNeighbors) {
      if (offset_px.x * step.x + offset_px.y * step.y <= 0) continue;  // the other half of the pixel
      const PixelAt beside{at.x + step.x, at.y + step.y};
      if (beside.x < 0 || beside.y < 0 || beside.x >= picture_.width_px || beside.y >= picture_.height_px) continue;
      std::atomic_ref sampled(memory_.sampled[index_of(beside)]);  // several threads may want it
      if (sampled.load(std::memory_order_relaxed)) continue;
      const std::span color_channels(&color.x, static_cast<size_t>(picture_.channels));
      if (contrasts(first_sample(beside), color_channels, kEdgeContrast) && !sampled.exchange(1))
        wanted.push_back(beside);
    }
  }

  Image& picture_;
  const EdgeSampling& sampling_;
  EdgeMemory& memory_;
  const TakeSamples& take_;
  std::mutex mutex_;
  std::vector<PixelAt> beside_;  ///< what the samples at hand want; under the mutex
};

}  // namespace

int64_t sample_edges(Image& picture, const EdgeSampling& sampling, ThreadPool& pool, EdgeMemory& memory,
                     const TakeSamples& take) {
  memory.sampled.resize(picture.pixel_count());
  mark_contrasts(picture, kEdgeContrast, pool, memory.sampled);
  return EdgeSampler(picture, sampling, memory, take).run();
}

}  // namespace hybridrt
