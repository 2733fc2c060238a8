#pragma once

#include <cstdint>
#include <vector>

#include "core/raster/depth_tile.h"
#include "core/raster/homogeneous.h"
#include "core/raster/screen.h"

namespace hybridrt {

/// Something to be drawn in a tile: a cluster, or a single triangle by its homogeneous edge functions.
struct BinItem {
  float nearest;            ///< an upper bound of its unit / distance
  uint32_t index;           ///< of the cluster; of the triangle in `single` of the worker's bins
  int32_t worker;           ///< -1: a cluster
  uint16_t x0, y0, x1, y1;  ///< pixels of the picture that it may touch, inclusive
};

/// What one worker put into the tiles.
struct WorkerBins {
  std::vector<std::vector<BinItem>> tiles;
  std::vector<HomogeneousTriangle> single;
};

/// A frame's clusters, sorted into the tiles that they may touch.
struct FrameBins {
  Screen screen;
  int tiles_x = 0, tiles_y = 0;
  std::vector<WorkerBins> workers;
  std::vector<uint32_t> order;  ///< all tiles, the fullest first, so that threads that take them in turn end together

  int tile_count() const { return tiles_x * tiles_y; }
};

}  // namespace hybridrt
