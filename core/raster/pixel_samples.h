#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/raster/clusters.h"
#include "core/raster/screen.h"
#include "core/trace/tile.h"

namespace hybridrt {

/// Several samples of some pixels of a tile, as DepthTile has one of each pixel. A pixel's samples lie side by side and
/// fill a vector, so that a triangle meets all of them at once: arrays have kLongestVector elements per pixel, of which
/// those beyond `count` are hidden. The DepthTile then has a pixel's number here as its triangle, and as `lo` the least
/// of its samples; pixels that are not here are hidden in it.
struct PixelSamples {
  int count = 0;                               ///< per pixel, at most kLongestVector
  float x[kLongestVector], y[kLongestVector];  ///< from (x, y), where the tile's screen samples the pixel
  dvec3 frame_first[kLongestVector];           ///< Screen::frame_first of each
  std::span<const PixelAt> pixels;             ///< of the picture
  std::vector<float> lo, hi;
  std::vector<uint32_t> triangle;
};

}  // namespace hybridrt
