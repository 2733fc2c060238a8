#include "core/raster/visibility.h"

#include <hwy/aligned_allocator.h>

#include "core/base/check.h"
#include "core/raster/near_first.h"
#include "core/raster/settle.h"

// clang-format off: the order matters
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "core/raster/visibility.cpp"
#include <hwy/foreach_target.h>  // includes this file once for each instruction set
#include <hwy/highway.h>

#include "core/raster/cluster_draw-inl.h"
#include "core/raster/cluster_samples-inl.h"
#include "core/raster/cull-inl.h"
// clang-format on

HWY_BEFORE_NAMESPACE();
namespace hybridrt {
namespace HWY_NAMESPACE {

void cull_clusters(const Scene& scene, const Clusters& clusters, size_t begin, size_t end, int worker,
                   FrameBins& bins) {
  ClusterCuller(scene, clusters, bins.screen, worker, bins).cull(begin, end);
}

/// A list of pending samples as long as this is settled before more is drawn, so that it hides what follows.
constexpr size_t kMostPending = 8192;

/// Draws items, nearest first, into the tile at `place`.
template <typename Draw>
void draw_items(const Clusters& clusters, const FrameBins& bins, const TileItems& items, const PixelBox& place,
                DepthTile& tile, Draw& draw) {
  const std::span<const uint32_t> order = items.order;
  for (size_t i = 0; i < order.size(); ++i) {
    constexpr size_t kAhead = 3;
    if (i + kAhead < order.size()) prefetch(clusters, items.items[order[i + kAhead]]);
    if (i + 3 * kAhead < order.size()) prefetch_head(clusters, items.items[order[i + 3 * kAhead]]);
    const BinItem& item = items.items[order[i]];
    const PixelBox box{std::max<int>(item.x0, place.x0), std::max<int>(item.y0, place.y0),
                       std::min<int>(item.x1, place.x1), std::min<int>(item.y1, place.y1)};
    const PixelBox in_tile{box.x0 - place.x0, box.y0 - place.y0, box.x1 - place.x0, box.y1 - place.y0};
    if (hides(tile, in_tile, item.nearest)) continue;
    if (item.worker >= 0)
      draw.draw(bins.workers[item.worker].single[item.index], box);
    else
      draw.draw(clusters.clusters[item.index], box);
    mark_stale(tile, in_tile);
    if (tile.pending.size() > kMostPending) draw.settle();
  }
  draw.settle();
}

void draw_tile(const Scene& scene, const Clusters& clusters, const FrameBins& bins, const TileItems& items,
               const PixelBox& place, DepthTile& tile) {
  clear_tile(tile, place);
  ClusterScratch scratch;
  ClusterDraw draw(scene, clusters, bins.screen, scratch, tile);
  draw_items(clusters, bins, items, place, tile, draw);
}

void draw_samples(const Scene& scene, const Clusters& clusters, const FrameBins& bins, const TileItems& items,
                  const PixelBox& place, DepthTile& tile, PixelSamples& samples) {
  clear_tile(tile, place);
  begin_samples(tile, samples);
  ClusterScratch scratch;
  ClusterSamples draw(scene, clusters, bins.screen, scratch, tile, samples);
  draw_items(clusters, bins, items, place, tile, draw);
}

}  // namespace HWY_NAMESPACE
}  // namespace hybridrt
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace hybridrt {

HWY_EXPORT(cull_clusters);
HWY_EXPORT(draw_tile);
HWY_EXPORT(draw_samples);

void bin_clusters(const Scene& scene, const Clusters& clusters, const View& view, ThreadPool& pool, FrameBins& bins,
                  double spread_px) {
  bins.screen = make_screen(view, scene.bounds, spread_px);
  bins.tiles_x = (view.width_px + kTileWidth_px - 1) / kTileWidth_px;
  bins.tiles_y = (view.height_px + kTileHeight_px - 1) / kTileHeight_px;
  bins.workers.resize(pool.size());
  const size_t tile_count = static_cast<size_t>(bins.tile_count());
  for (WorkerBins& worker : bins.workers) {
    worker.tiles.resize(tile_count);
    for (std::vector<BinItem>& tile : worker.tiles) tile.clear();
    worker.single.clear();
  }

  constexpr size_t kClustersPerChunk = 512;
  const size_t count = clusters.clusters.size();
  pool.run((count + kClustersPerChunk - 1) / kClustersPerChunk, [&](size_t chunk, int worker) {
    const size_t begin = chunk * kClustersPerChunk, end = std::min(count, begin + kClustersPerChunk);
    HWY_DYNAMIC_DISPATCH(cull_clusters)(scene, clusters, begin, end, worker, bins);
  });

  std::vector<size_t> items(tile_count);
  bins.order.resize(tile_count);
  for (size_t t = 0; t < tile_count; ++t) {
    for (const WorkerBins& worker : bins.workers) items[t] += worker.tiles[t].size();
    bins.order[t] = static_cast<uint32_t>(t);
  }
  std::stable_sort(bins.order.begin(), bins.order.end(), [&](uint32_t a, uint32_t b) { return items[a] > items[b]; });
}

namespace {

PixelBox place_of_tile(const FrameBins& bins, int tile) {
  const int x0 = tile % bins.tiles_x * kTileWidth_px, y0 = tile / bins.tiles_x * kTileHeight_px;
  return {x0, y0, std::min(x0 + kTileWidth_px, bins.screen.width_px) - 1,
          std::min(y0 + kTileHeight_px, bins.screen.height_px) - 1};
}

/// Where the samples of these views lie.
void place_samples(const Screen& screen, std::span<const View> views, PixelSamples& samples) {
  samples.count = static_cast<int>(views.size());
  for (int s = 0; s < kLongestVector; ++s) {
    const View& view = views[std::min<size_t>(s, views.size() - 1)];
    const dvec2 from_pixel_px = view.sample_px - screen.sample_px;
    HRT_CHECK(std::max(std::abs(from_pixel_px.x), std::abs(from_pixel_px.y)) <= screen.spread_px);
    samples.x[s] = static_cast<float>(from_pixel_px.x), samples.y[s] = static_cast<float>(from_pixel_px.y);
    samples.frame_first[s] = view.ray_first();
  }
}

}  // namespace

struct TileRaster::Memory {
  hwy::AlignedUniquePtr<DepthTile> depth = hwy::MakeUniqueAligned<DepthTile>();
  PixelSamples samples;
  std::vector<BinItem> items;
  DepthOrder order;

  TileItems items_of(const FrameBins& bins, int tile) {
    HRT_CHECK(tile >= 0 && tile < bins.tile_count());
    items.clear();
    for (const WorkerBins& worker : bins.workers)
      items.insert(items.end(), worker.tiles[tile].begin(), worker.tiles[tile].end());
    return {items, order.nearest_first(items)};
  }
};

TileRaster::TileRaster() : memory_(std::make_unique<Memory>()) {}
TileRaster::~TileRaster() = default;
TileRaster::TileRaster(TileRaster&&) noexcept = default;

const DepthTile& TileRaster::depth() const { return *memory_->depth; }

void TileRaster::draw(const Scene& scene, const Clusters& clusters, const FrameBins& bins, int tile) {
  const TileItems items = memory_->items_of(bins, tile);
  HWY_DYNAMIC_DISPATCH(draw_tile)(scene, clusters, bins, items, place_of_tile(bins, tile), *memory_->depth);
}

void TileRaster::find_samples(const Scene& scene, const Clusters& clusters, const FrameBins& bins, int tile,
                              std::span<const View> views, std::span<const PixelAt> pixels,
                              std::span<uint32_t> triangles) {
  HRT_CHECK_EQ(triangles.size(), pixels.size() * views.size());
  const TileItems items = memory_->items_of(bins, tile);
  PixelSamples& samples = memory_->samples;
  samples.pixels = pixels;
  for (size_t first = 0; first < views.size(); first += kLongestVector) {
    const std::span<const View> some = views.subspan(first, std::min<size_t>(kLongestVector, views.size() - first));
    place_samples(bins.screen, some, samples);
    HWY_DYNAMIC_DISPATCH(draw_samples)
    (scene, clusters, bins, items, place_of_tile(bins, tile), *memory_->depth, samples);
    for (size_t i = 0; i < pixels.size(); ++i)
      std::copy_n(&samples.triangle[i * kLongestVector], some.size(), &triangles[i * views.size() + first]);
  }
}

void rasterize_ids(const Scene& scene, const Clusters& clusters, const View& view, ThreadPool& pool,
                   RasterMemory& memory, std::span<uint32_t> ids) {
  HRT_CHECK_EQ(ids.size(), static_cast<size_t>(view.width_px) * view.height_px);
  FrameBins& bins = memory.bins;
  bin_clusters(scene, clusters, view, pool, bins);
  memory.tiles.resize(pool.size());
  pool.run(bins.order.size(), [&](size_t i, int worker) {
    TileRaster& raster = memory.tiles[worker];
    raster.draw(scene, clusters, bins, static_cast<int>(bins.order[i]));
    const DepthTile& tile = raster.depth();
    for (int y = 0; y < tile.height_px; ++y)
      std::copy_n(tile.triangle + y * kTileStride, tile.width_px,
                  &ids[static_cast<size_t>(tile.y_px + y) * view.width_px + tile.x_px]);
  });
}

}  // namespace hybridrt
#endif  // HWY_ONCE
