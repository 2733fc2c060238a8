#include "core/render/frame_edges.h"

#include <algorithm>
#include <optional>

#include "core/base/timing.h"
#include "core/render/edge_worker.h"

namespace hybridrt {
namespace {

/// The rasteriser finds what at least so many pixels of a tile see; rays are cheaper for fewer.
constexpr size_t kRasterised = 32;

/// Some of the pixels at hand, all in one tile.
struct TilePart {
  int tile;
  size_t first, count;  ///< of the pixels
};

class EdgeTaker {
 public:
  EdgeTaker(const TileJob& job, const EdgeSampling& sampling, const EdgeFinders& finders, ThreadPool& pool)
      : job_(job), sampling_(sampling), finders_(finders), pool_(pool), workers_(pool.size()) {
    if (finders.clusters) finders.raster.tiles.resize(pool.size());
  }

  void take(std::span<const PixelAt> pixels, const GiveColors& give) {
    std::vector<TilePart> parts = parts_of(pixels);
    // The most work first, so that threads end together.
    std::ranges::stable_sort(parts, std::greater(), &TilePart::count);
    if (finders_.clusters && parts.front().count >= kRasterised) bin();
    pool_.run(parts.size(), [&](size_t p, int number) {
      const auto [tile, first, count] = parts[p];
      const bool by_rays = !finders_.clusters || count < kRasterised;
      give(first, count, worker(number).take(pixels.subspan(first, count), by_rays ? kByRays : tile));
    });
  }

  void add_to(Frame& frame, double wall_ms) const {
    PassTimes threads_ms{};
    for (const std::optional<EdgeWorker>& worker : workers_) {
      if (!worker) continue;
      frame.stats.add(worker->tile().stats());
      for (size_t pass = 0; pass < threads_ms.size(); ++pass) threads_ms[pass] += worker->tile().times_ms()[pass];
    }
    add_threads_times(frame.timings, threads_ms, wall_ms);
  }

 private:
  EdgeWorker& worker(int number) {
    std::optional<EdgeWorker>& worker = workers_[number];
    if (!worker) worker.emplace(job_, sampling_, finders_.clusters ? &finders_.raster.tiles[number] : nullptr);
    return *worker;
  }

  std::vector<TilePart> parts_of(std::span<const PixelAt> pixels) const {
    const int tiles_x = (job_.plan.view.width_px + kTileWidth_px - 1) / kTileWidth_px;
    std::vector<TilePart> parts;
    for (size_t i = 0; i < pixels.size(); ++i) {
      const int tile = pixels[i].y / kTileHeight_px * tiles_x + pixels[i].x / kTileWidth_px;
      if (parts.empty() || parts.back().tile != tile || parts.back().count == sampling_.pixels_at_once())
        parts.push_back({tile, i, 0});
      ++parts.back().count;
    }
    return parts;
  }

  /// Sorts the clusters into the tiles in which samples may see them, once per frame.
  void bin() {
    if (binned_) return;
    binned_ = true;
    bin_clusters(job_.trace.scene, *finders_.clusters, job_.plan.view, pool_, finders_.raster.bins, kSampleSpread_px);
  }

  const TileJob& job_;
  const EdgeSampling& sampling_;
  const EdgeFinders& finders_;
  ThreadPool& pool_;
  std::vector<std::optional<EdgeWorker>> workers_;
  bool binned_ = false;
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
  const EdgeSampling sampling{settings.samples, /*retake_first=*/trace.scene.textures != nullptr};
  EdgeTaker taker(job, sampling, finders, pool);
  frame.stats.pixels_resampled =
      sample_edges(frame.picture, sampling, pool, finders.memory,
                   [&](std::span<const PixelAt> pixels, const GiveColors& give) { taker.take(pixels, give); });
  taker.add_to(frame, watch.elapsed_ms());
}

}  // namespace hybridrt
