#include "core/render/frame_edges.h"

#include <algorithm>
#include <array>
#include <optional>

#include "core/base/timing.h"
#include "core/render/samples.h"
#include "core/render/tile_frame.h"

namespace hybridrt {
namespace {

/// The rasteriser draws a sample of the frame if it has at least this share of its pixels; rays are cheaper for fewer.
constexpr double kRasterisedShare = 0.02;

class EdgeTaker {
 public:
  EdgeTaker(const TileJob& job, int samples, const EdgeFinders& finders, ThreadPool& pool)
      : job_(job), samples_(samples), finders_(finders), pool_(pool), workers_(pool.size()) {
    if (finders.clusters) finders.raster.tiles.resize(pool.size());
  }

  void take(int sample, std::span<const PixelAt> pixels, std::span<vec4> colors) {
    view_ = job_.plan.view;
    view_.sample_px = sample_offset_px(sample);
    view_.samples = samples_;
    const size_t frame_pixels = job_.pixels.picture.pixel_count();
    if (finders_.clusters && static_cast<double>(pixels.size()) >= kRasterisedShare * static_cast<double>(frame_pixels))
      rasterize(pixels, colors);
    else
      trace(pixels, colors);
  }

  void add_to(Frame& frame, double wall_ms) const {
    PassTimes threads_ms{};
    for (const std::optional<TileWorker>& worker : workers_) {
      if (!worker) continue;
      frame.stats.add(worker->stats());
      for (size_t pass = 0; pass < threads_ms.size(); ++pass) threads_ms[pass] += worker->times_ms()[pass];
    }
    add_threads_times(frame.timings, threads_ms, wall_ms);
  }

 private:
  TileWorker& worker(int number) {
    std::optional<TileWorker>& worker = workers_[number];
    if (!worker) worker.emplace(job_, finders_.clusters ? &finders_.raster.tiles[number] : nullptr);
    return *worker;
  }

  void trace(std::span<const PixelAt> pixels, std::span<vec4> colors) {
    const size_t most = TileWorker::kMostPixels;
    pool_.run((pixels.size() + most - 1) / most, [&](size_t chunk, int number) {
      const size_t first = chunk * most, count = std::min(most, pixels.size() - first);
      const std::span<const PixelAt> some = pixels.subspan(first, count);
      worker(number).render_pixels(view_, some, worker(number).find_triangles(view_, some),
                                   colors.subspan(first, count));
    });
  }

  void rasterize(std::span<const PixelAt> pixels, std::span<vec4> colors) {
    FrameBins& bins = finders_.raster.bins;
    bin_clusters(job_.trace.scene, *finders_.clusters, view_, pool_, bins);
    const auto tile_of = [&](PixelAt at) { return at.y / kTileHeight_px * bins.tiles_x + at.x / kTileWidth_px; };
    struct TilePart {
      size_t first, count;  ///< of the pixels
    };
    std::vector<TilePart> parts;
    for (size_t i = 0; i < pixels.size(); ++i) {
      if (i == 0 || tile_of(pixels[i]) != tile_of(pixels[i - 1])) parts.push_back({i, 0});
      ++parts.back().count;
    }
    // The most work first, so that threads end together.
    std::ranges::sort(parts, std::greater(), &TilePart::count);
    pool_.run(parts.size(), [&](size_t i, int number) {
      const auto [begin, count] = parts[i];
      worker(number).render_pixels_of_tile(view_, tile_of(pixels[begin]), pixels.subspan(begin, count),
                                           colors.subspan(begin, count));
    });
  }

  const TileJob& job_;
  const int samples_;
  const EdgeFinders& finders_;
  ThreadPool& pool_;
  std::vector<std::optional<TileWorker>> workers_;
  View view_;  ///< at the sample at hand
};

}  // namespace

void sample_frame_edges(const FramePlan& plan, const TraceJob& trace, const RenderSettings& settings,
                        const EdgeFinders& finders, ThreadPool& pool, Frame& frame) {
  const Stopwatch watch;
  const Clusters no_clusters;
  const TileJob job{plan,
                    trace,
                    finders.clusters ? *finders.clusters : no_clusters,
                    finders.raster.bins,
                    &finders.caster,
                    {frame.picture, {}, {}, {}, {}}};
  EdgeTaker taker(job, settings.samples, finders, pool);
  const EdgeSampling sampling{settings.samples, /*retake_first=*/trace.scene.textures != nullptr};
  frame.stats.pixels_resampled = sample_edges(
      frame.picture, sampling, pool, finders.memory,
      [&](int sample, std::span<const PixelAt> pixels, std::span<vec4> colors) { taker.take(sample, pixels, colors); });
  taker.add_to(frame, watch.elapsed_ms());
}

}  // namespace hybridrt
