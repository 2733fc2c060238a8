#pragma once

#include "core/render/edge_samples.h"
#include "core/render/tile_frame.h"

namespace hybridrt {

/// One thread's work on the samples near edges.
class EdgeWorker {
 public:
  /// `raster`: memory that outlives the frame; null if only rays find triangles.
  EdgeWorker(const TileJob& job, const EdgeSampling& sampling, TileRaster* raster);

  /// The colours of some pixels of one tile of the rasteriser, at most EdgeSampling::pixels_at_once(), as GiveColors
  /// has them. `tile`: of the job's bins, which are spread (kSampleSpread_px); negative: rays find what they see. Valid
  /// until the next call.
  std::span<const vec4> take(std::span<const PixelAt> pixels, int tile);

  const TileWorker& tile() const { return tile_; }  ///< for its times and counts

 private:
  void shade(int sample, std::span<const PixelAt> pixels);

  const EdgeSampling& sampling_;
  TileWorker tile_;
  std::vector<View> views_;  ///< at each sample

  // Of the pixels at hand.
  std::vector<uint32_t> triangles_;  ///< per pixel and sample, a pixel's side by side
  std::vector<vec4> colors_;         ///< per sample and pixel, a sample's side by side
};

inline constexpr int kByRays = -1;  ///< in place of a tile

}  // namespace hybridrt
