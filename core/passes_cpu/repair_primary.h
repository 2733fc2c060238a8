#pragma once

#include "core/raster/visibility.h"

namespace hybridrt {

/// Counts of repair_primary_hits.
struct RepairStats {
  int64_t checked = 0;   ///< pixels
  int64_t repaired = 0;  ///< those that see another triangle than the GL's
};

/// A GL snaps vertices to a fraction of a pixel, so about one pixel in two thousand names a triangle that its centre
/// misses, or one behind the triangle that its centre meets; and it clips huge triangles in single precision. `ids`:
/// what it drew, rows from the top. `repaired`: the same, corrected by the exact rasteriser, so that ids are those of
/// the reference at every pixel.
RepairStats repair_primary_hits(const Scene& scene, const Clusters& clusters, const View& view, ThreadPool& pool,
                                RasterMemory& memory, std::span<const uint32_t> ids, std::span<uint32_t> repaired);

}  // namespace hybridrt
