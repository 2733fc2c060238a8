#pragma once

#include <cstddef>

#include "core/raster/bins.h"
#include "core/raster/clusters.h"

namespace hybridrt {

/// Puts an item into the bins of `worker`, for all tiles that its box touches.
void add_to_tiles(FrameBins& bins, int worker, const BinItem& item);

/// Puts the triangles of a cluster at or around the eye, one by one, into the tiles that they may touch.
void bin_triangles(const Scene& scene, const Clusters& clusters, size_t cluster, const Screen& screen, int worker,
                   FrameBins& bins);

}  // namespace hybridrt
