// See lanes-inl.h for the toggle.
#if defined(HYBRIDRT_RASTER_SPANS_H) == defined(HWY_TARGET_TOGGLE)
#ifdef HYBRIDRT_RASTER_SPANS_H
#undef HYBRIDRT_RASTER_SPANS_H
#else
#define HYBRIDRT_RASTER_SPANS_H
#endif

#include <cmath>
#include <optional>

#include "core/raster/hole_lanes-inl.h"
#include "core/raster/homogeneous.h"
#include "core/raster/tile_depth-inl.h"

HWY_BEFORE_NAMESPACE();
namespace hybridrt {
namespace HWY_NAMESPACE {

/// Of several rows, in pixels from the box's first: where the triangle may be, and where it certainly is. The two
/// differ only where a pixel's centre lies within the error of an edge.
struct Spans {
  Floats may_first, may_last, sure_first, sure_last;
};

/// The rows `y` of the triangle's box. An edge is solved for x: x = (-rest -+ error) / dx, rounded three times; 2^-21
/// of it covers that.
inline Spans spans_of_rows(const EdgeTriangle& t, Floats y) {
  const Floats rounding = all(0x1p-21f), width = all(static_cast<float>(t.box.x1 - t.box.x0));
  Spans s{all(0), width, all(0), width};
  for (int k = 0; k < 3; ++k) {
    const Floats rest = sum_of(all(t.dy[k]), y, all(t.edge[k])), error = all(t.error[k]);
    if (std::abs(t.dx[k]) > 1e-12f) {
      // Which side an edge bounds is as good as random: no branch, the other side's bound is moved out of the way.
      const Floats not_left = all(t.dx[k] > 0 ? 0.0f : -1e30f), not_right = all(t.dx[k] > 0 ? 1e30f : 0.0f);
      const Floats per_dx = all(t.x_per_dx[k]);
      const Floats may = (rest + error) * per_dx, sure = (rest - error) * per_dx;
      const Floats may_room = sum_of(hn::Abs(may), rounding, rounding),
                   sure_room = sum_of(hn::Abs(sure), rounding, rounding);
      s.may_first = hn::Max(s.may_first, (may - may_room) + not_left);
      s.sure_first = hn::Max(s.sure_first, (sure + sure_room) + not_left);
      s.may_last = hn::Min(s.may_last, (may + may_room) + not_right);
      s.sure_last = hn::Min(s.sure_last, (sure - sure_room) + not_right);
    } else {  // along the row it changes by far less than its error
      s.may_last = hn::IfThenElse(hn::Lt(hn::Neg(error), rest), s.may_last, all(-1));
      s.sure_last = hn::IfThenElse(hn::Lt(error, rest), s.sure_last, all(-1));
    }
  }
  const Mask in_box = hn::And(hn::Ge(y, all(0)), hn::Le(y, all(static_cast<float>(t.box.y1 - t.box.y0))));
  s.may_first = hn::Ceil(s.may_first), s.sure_first = hn::Ceil(s.sure_first);
  s.may_last = hn::IfThenElse(in_box, hn::Floor(s.may_last), all(-1));
  s.sure_last = hn::Max(hn::Floor(s.sure_last), all(-2));
  return s;
}

/// Pixels from the tile's left edge, inclusive.
struct RowSpan {
  int may_first, may_last, sure_first, sure_last;
};

inline Mask between_lanes(int first, int last) { return hn::AndNot(first_lanes(first), first_lanes(last + 1)); }

/// Samples a row of the tile, a pixel a lane: aligned whole vectors, blended and stored, so that the next triangle's
/// loads find the same addresses and need not wait. `depth_at_0`: the triangle's at the first pixel of its box.
/// Without `holes` no sample of a triangle with holes is certain.
inline void sample_row(DepthTile& tile, const EdgeTriangle& t, const std::optional<HoleLanes>& holes, float depth_at_0,
                       int y, const RowSpan& span) {
  const Floats step = all(t.depth_dx), error = all(t.depth_error), row = all(depth_at_0);
  for (int x = span.may_first & ~(kLanes - 1); x <= span.may_last; x += kLanes) {
    const Mask may = between_lanes(span.may_first - x, span.may_last - x);
    const Mask certain = between_lanes(span.sure_first - x, span.sure_last - x);
    const int place = y * kTileStride + x;
    const Floats from_x = lane_numbers() + all(static_cast<float>(x - t.box.x0));
    const Floats depth = sum_of(step, from_x, row);
    const Floats lo = depth - error, hi = depth + error;
    const Floats tile_lo = load(tile.lo + place), tile_hi = load(tile.hi + place);
    Mask visible = hn::AndNot(hn::Lt(hi, tile_lo), may);
    Mask sure = hn::And(visible, certain);
    if (t.has_holes) decide_holes(holes, from_x, all(static_cast<float>(y - t.box.y0)), depth, sure, visible);
    sure = hn::And(sure, hn::Lt(tile_hi, lo));
    store(tile.lo + place, hn::IfThenElse(sure, lo, tile_lo));
    store(tile.hi + place, hn::IfThenElse(sure, hi, tile_hi));
    store_int(tile.triangle + place, hn::IfThenElse(hn::RebindMask(kInts, sure), all_int(static_cast<int>(t.triangle)),
                                                    load_int(tile.triangle + place)));
    queue_lanes(tile, bits_of(hn::AndNot(sure, visible)), static_cast<uint32_t>(place), t.triangle,
                hn::Min(hi, all(t.nearest)));
  }
}

/// Rows of a triangle's box as the tile's blocks lie.
struct BlockRows {
  HWY_ALIGN int32_t may_first[kLongestVector], may_last[kLongestVector], sure_first[kLongestVector],
      sure_last[kLongestVector];
};

/// Samples a triangle of any size; blocks of the tile in which it is hidden are left out where it is large.
inline void sample_triangle(DepthTile& tile, const EdgeTriangle& t, const std::optional<HoleLanes>& holes) {
  const PixelBox& box = t.box;
  const bool large = box.x1 - box.x0 >= 2 * kBlockWidth_px && box.y1 - box.y0 >= kBlockHeight_px;
  constexpr int kRows = std::min(kLanes, kBlockHeight_px);
  BlockRows rows;
  for (int y0 = box.y0 & ~(kRows - 1); y0 <= box.y1; y0 += kLanes) {
    const Spans s = spans_of_rows(t, lane_numbers() + all(static_cast<float>(y0 - box.y0)));
    store_int(rows.may_first, hn::ConvertTo(kInts, s.may_first));
    store_int(rows.may_last, hn::ConvertTo(kInts, s.may_last));
    store_int(rows.sure_first, hn::ConvertTo(kInts, s.sure_first));
    store_int(rows.sure_last, hn::ConvertTo(kInts, s.sure_last));
    const int first = std::max(0, box.y0 - y0), last = std::min(kLanes - 1, box.y1 - y0);
    const auto sample = [&](int k, int from, int to) {
      const float depth = t.depth_dy * static_cast<float>(y0 + k - box.y0) + t.depth;
      sample_row(tile, t, holes, depth, y0 + k,
                 {from + box.x0, to + box.x0, rows.sure_first[k] + box.x0, rows.sure_last[k] + box.x0});
    };
    if (!large) {
      for (int k = first; k <= last; ++k)
        if (rows.may_first[k] <= rows.may_last[k]) sample(k, rows.may_first[k], rows.may_last[k]);
      continue;
    }
    for (int k0 = 0; k0 <= last; k0 += kRows) {
      const int k_first = std::max(k0, first), k_last = std::min(k0 + kRows - 1, last);
      int left = kTileStride, right = -1;
      for (int k = k_first; k <= k_last; ++k)
        if (rows.may_first[k] <= rows.may_last[k])
          left = std::min(left, rows.may_first[k]), right = std::max(right, rows.may_last[k]);
      const float above = static_cast<float>(y0 + k_first - box.y0), below = static_cast<float>(y0 + k_last - box.y0);
      for (int i = (box.x0 + left) / kBlockWidth_px; left <= right && i <= (box.x0 + right) / kBlockWidth_px; ++i) {
        const int block_left = std::max(left, i * kBlockWidth_px - box.x0);
        const int block_right = std::min(right, (i + 1) * kBlockWidth_px - 1 - box.x0);
        const float top =
            t.depth +
            std::max(t.depth_dx * static_cast<float>(block_left), t.depth_dx * static_cast<float>(block_right)) +
            std::max(t.depth_dy * above, t.depth_dy * below) + 2 * t.depth_error;
        const PixelBox block{box.x0 + block_left, y0 + k_first, box.x0 + block_right, y0 + k_last};
        if (blocks_hide(tile, block, std::min(top, t.nearest))) continue;
        for (int k = k_first; k <= k_last; ++k) {
          const int from = std::max<int>(rows.may_first[k], block_left),
                    to = std::min<int>(rows.may_last[k], block_right);
          if (from <= to) sample(k, from, to);
        }
        mark_stale(tile, block);
      }
    }
  }
}

/// Queues every sample in the box that is not certainly missed: of a triangle whose turn is unknown, and so all signs.
inline void queue_triangle(DepthTile& tile, const EdgeTriangle& t) {
  for (int y = t.box.y0; y <= t.box.y1; ++y)
    for (int x = t.box.x0; x <= t.box.x1; x += kLanes) {
      const Floats dx = lane_numbers() + all(static_cast<float>(x - t.box.x0));
      Mask positive = first_lanes(t.box.x1 - x + 1), negative = positive;
      for (int k = 0; k < 3; ++k) {
        const float row = t.dy[k] * static_cast<float>(y - t.box.y0) + t.edge[k];
        const Floats value = all(t.dx[k]) * dx + all(row);
        positive = hn::And(positive, hn::Gt(value, all(-t.error[k])));
        negative = hn::And(negative, hn::Lt(value, all(t.error[k])));
      }
      for (uint32_t rest = bits_of(hn::Or(positive, negative)); rest != 0; rest &= rest - 1)
        queue(tile, static_cast<uint32_t>(y * kTileStride + x + __builtin_ctz(rest)), t.triangle, t.nearest);
    }
}

/// A triangle in a box of the picture that lies in the tile.
inline void draw_homogeneous(DepthTile& tile, const HomogeneousTriangle& t, const PixelBox& box) {
  const EdgeTriangle edges = edges_in_box(t, box, tile.x_px, tile.y_px);
  if (t.turn_known)
    sample_triangle(tile, edges, std::nullopt);
  else
    queue_triangle(tile, edges);
}

}  // namespace HWY_NAMESPACE
}  // namespace hybridrt
HWY_AFTER_NAMESPACE();

#endif
