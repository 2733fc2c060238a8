#pragma once

#include <cstdint>
#include <vector>

namespace hybridrt {

/// Size of a tile of the picture, which one thread draws at a time: its arrays fit the second-level cache.
inline constexpr int kTileWidth_px = 256, kTileHeight_px = 128;
inline constexpr int kTileStride = kTileWidth_px + 16;  ///< elements per row: vectors may reach over the right edge
inline constexpr int kTilePlaces = kTileHeight_px * kTileStride + 16;

/// Blocks of the coarse depth.
inline constexpr int kBlockWidth_px = 16, kBlockHeight_px = 8;
inline constexpr int kBlocksX = kTileWidth_px / kBlockWidth_px, kBlocksY = kTileHeight_px / kBlockHeight_px;

/// A sample that single precision cannot decide: the triangle may be the one that is seen at `place`.
struct PendingSample {
  uint32_t place;     ///< in the arrays of the tile
  uint32_t triangle;  ///< index in the scene
  float nearest;      ///< an upper bound of its unit / distance there
};

/// What is seen so far at each pixel of a tile: the triangle, and an interval that holds its unit / distance (see
/// Screen::unit), distances being along the camera's axis. Where nothing is seen the interval is [-1, -1].
struct alignas(64) DepthTile {
  float lo[kTilePlaces], hi[kTilePlaces];
  uint32_t triangle[kTilePlaces];

  float block_lo[kBlocksX * kBlocksY];    ///< at most the smallest `lo` of the block
  bool block_stale[kBlocksX * kBlocksY];  ///< whether it may have grown since

  int x_px = 0, y_px = 0, width_px = 0,
      height_px = 0;  ///< the tile's place in the picture; less than full at its edges
  std::vector<PendingSample> pending;
};

/// Pixels of a tile, or of the picture, all inclusive.
struct PixelBox {
  int x0, y0, x1, y1;
};

}  // namespace hybridrt
