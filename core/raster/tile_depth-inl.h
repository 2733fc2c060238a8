// See lanes-inl.h for the toggle.
#if defined(HYBRIDRT_RASTER_TILE_DEPTH_H) == defined(HWY_TARGET_TOGGLE)
#ifdef HYBRIDRT_RASTER_TILE_DEPTH_H
#undef HYBRIDRT_RASTER_TILE_DEPTH_H
#else
#define HYBRIDRT_RASTER_TILE_DEPTH_H
#endif

#include "core/base/math.h"
#include "core/raster/depth_tile.h"
#include "core/raster/lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace hybridrt {
namespace HWY_NAMESPACE {

/// Boxes up to this size are asked pixel by pixel: cheaper than keeping blocks fresh, and sharper.
constexpr int kAskedByPixel_px = 24;

inline void clear_tile(DepthTile& tile, const PixelBox& place) {
  tile.x_px = place.x0, tile.y_px = place.y0;
  tile.width_px = place.x1 - place.x0 + 1, tile.height_px = place.y1 - place.y0 + 1;
  for (int i = 0; i < tile.height_px * kTileStride; i += kLanes) {
    store(tile.lo + i, all(-1)), store(tile.hi + i, all(-1));
    store_int(tile.triangle + i, all_int(-1));
  }
  for (int b = 0; b < kBlocksX * kBlocksY; ++b) tile.block_lo[b] = -1, tile.block_stale[b] = false;
  tile.pending.clear();
}

inline void queue(DepthTile& tile, uint32_t place, uint32_t triangle, float nearest) {
  tile.pending.push_back({place, triangle, nearest});
}

/// The lanes of `bits`; the first lane's place is `place`.
inline void queue_lanes(DepthTile& tile, uint32_t bits, uint32_t place, uint32_t triangle, Floats nearest) {
  if (bits == 0) return;
  HWY_ALIGN float nearest_of[kLongestVector];
  store(nearest_of, nearest);
  for (; bits != 0; bits &= bits - 1) {
    const int lane = __builtin_ctz(bits);
    queue(tile, place + static_cast<uint32_t>(lane), triangle, nearest_of[lane]);
  }
}

inline void mark_stale(DepthTile& tile, const PixelBox& box) {
  for (int j = box.y0 / kBlockHeight_px; j <= box.y1 / kBlockHeight_px; ++j)
    for (int i = box.x0 / kBlockWidth_px; i <= box.x1 / kBlockWidth_px; ++i) tile.block_stale[j * kBlocksX + i] = true;
}

inline float smallest_in_block(const DepthTile& tile, int i, int j) {
  const int width = std::min(kBlockWidth_px, tile.width_px - i * kBlockWidth_px);
  const int height = std::min(kBlockHeight_px, tile.height_px - j * kBlockHeight_px);
  Floats least = all(3e38f);
  for (int y = 0; y < height; ++y) {
    const float* row = tile.lo + (j * kBlockHeight_px + y) * kTileStride + i * kBlockWidth_px;
    for (int x = 0; x < width; x += kLanes)
      least = hn::Min(least, hn::IfThenElse(first_lanes(width - x), load(row + x), all(3e38f)));
  }
  return smallest(least);
}

inline bool blocks_hide(DepthTile& tile, const PixelBox& box, float nearest) {
  for (int j = box.y0 / kBlockHeight_px; j <= box.y1 / kBlockHeight_px; ++j)
    for (int i = box.x0 / kBlockWidth_px; i <= box.x1 / kBlockWidth_px; ++i) {
      const int b = j * kBlocksX + i;
      if (nearest < tile.block_lo[b]) continue;
      if (!tile.block_stale[b]) return false;
      tile.block_stale[b] = false;
      tile.block_lo[b] = smallest_in_block(tile, i, j);
      if (!(nearest < tile.block_lo[b])) return false;
    }
  return true;
}

/// Whether everything in the box (of the tile) is certainly in front of what is nowhere nearer than `nearest`.
inline bool hides(DepthTile& tile, const PixelBox& box, float nearest) {
  if (box.x1 - box.x0 >= kAskedByPixel_px || box.y1 - box.y0 >= kAskedByPixel_px)
    return blocks_hide(tile, box, nearest);
  const Floats limit = all(nearest);
  for (int y = box.y0; y <= box.y1; ++y)
    for (int x = box.x0; x <= box.x1; x += kLanes) {
      const Mask hidden = hn::Lt(limit, load(tile.lo + y * kTileStride + x));
      if (!hn::AllFalse(kFloats, hn::AndNot(hidden, first_lanes(box.x1 - x + 1)))) return false;
    }
  return true;
}

}  // namespace HWY_NAMESPACE
}  // namespace hybridrt
HWY_AFTER_NAMESPACE();

#endif
