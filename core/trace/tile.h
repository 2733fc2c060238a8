#pragma once

#include <algorithm>
#include <cstdint>

namespace hybridrt {

/// A pixel of a picture, row 0 on top.
struct PixelAt {
  int x = 0, y = 0;
};

/// A rectangle of a picture.
struct Tile {
  int x0, y0, x1, y1;  ///< pixels [x0, x1) x [y0, y1)
  uint32_t width() const { return static_cast<uint32_t>(x1 - x0); }
  uint32_t pixel_count() const { return width() * static_cast<uint32_t>(y1 - y0); }

  static constexpr int kBlock_px = 4;

  /// Calls body(x, y, index in the tile, counted row by row) in square blocks, so that neighbouring rays form packets
  /// and neighbouring queries ask the same cells.
  template <typename Body>
  void for_each_pixel_in_blocks(const Body& body) const {
    for (int block_y = y0; block_y < y1; block_y += kBlock_px)
      for (int block_x = x0; block_x < x1; block_x += kBlock_px)
        for (int y = block_y; y < std::min(block_y + kBlock_px, y1); ++y)
          for (int x = block_x; x < std::min(block_x + kBlock_px, x1); ++x)
            body(x, y, static_cast<uint32_t>(y - y0) * width() + static_cast<uint32_t>(x - x0));
  }
};

}  // namespace hybridrt
