#pragma once

#include <memory>
#include <span>

#include "core/base/parallel.h"
#include "core/raster/bins.h"
#include "core/raster/clusters.h"
#include "core/scene/view.h"
#include "core/trace/tile.h"

namespace hybridrt {

// Which triangle each pixel sees, by software rasterisation, exactly: the triangle that the double-precision ray test
// (intersect_triangle, is_hole, NearestHit) finds nearest along the ray through the pixel's sample. Single precision
// decides what its error bounds allow; each sample is a certain miss, a certain hit whose interval of depth lies before
// or behind the pixel's, or is queued and settled by that same double-precision test. Nothing is clipped, snapped or
// culled by its facing, and the result does not depend on the order of the work. docs/method.md explains it.

/// Finds the clusters that may be seen and sorts them into the picture's tiles: `bins`, whose memory is used again.
/// `scene` is the one that the clusters were made of. `spread_px`: how far samples that will be drawn may lie from the
/// view's own: 0, or kSampleSpread_px for all of a pixel.
void bin_clusters(const Scene& scene, const Clusters& clusters, const View& view, ThreadPool& pool, FrameBins& bins,
                  double spread_px = 0);

/// Memory of one thread for the tile at hand.
class TileRaster {
 public:
  TileRaster();
  ~TileRaster();
  TileRaster(TileRaster&&) noexcept;

  /// Draws the tile `tile` (0 to bins.tile_count() - 1) into depth(). The arguments are only read.
  void draw(const Scene& scene, const Clusters& clusters, const FrameBins& bins, int tile);

  /// Finds what some pixels of a tile (of the picture) see at several samples: `views` are the bins' view, at each
  /// sample, which lies within the bins' spread. `triangles`: one per pixel and sample, a pixel's side by side, or
  /// kNoTriangle. Vertices and triangles are set up once for up to kLongestVector samples.
  void find_samples(const Scene& scene, const Clusters& clusters, const FrameBins& bins, int tile,
                    std::span<const View> views, std::span<const PixelAt> pixels, std::span<uint32_t> triangles);

  /// The tile that was drawn last; nothing is pending in it.
  const DepthTile& depth() const;

 private:
  struct Memory;
  std::unique_ptr<Memory> memory_;
};

/// What is kept from picture to picture.
struct RasterMemory {
  FrameBins bins;
  std::vector<TileRaster> tiles;  ///< one per thread
};

/// All tiles of a picture: `ids` has one element per pixel, rows from the top.
void rasterize_ids(const Scene& scene, const Clusters& clusters, const View& view, ThreadPool& pool,
                   RasterMemory& memory, std::span<uint32_t> ids);

}  // namespace hybridrt
