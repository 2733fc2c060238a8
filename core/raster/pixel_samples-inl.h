// See lanes-inl.h for the toggle.
#if defined(HYBRIDRT_RASTER_PIXEL_SAMPLES_H) == defined(HWY_TARGET_TOGGLE)
#ifdef HYBRIDRT_RASTER_PIXEL_SAMPLES_H
#undef HYBRIDRT_RASTER_PIXEL_SAMPLES_H
#else
#define HYBRIDRT_RASTER_PIXEL_SAMPLES_H
#endif

#include <cmath>
#include <limits>
#include <optional>

#include "core/raster/hole_lanes-inl.h"
#include "core/raster/homogeneous.h"
#include "core/raster/pixel_samples.h"
#include "core/raster/tile_depth-inl.h"

HWY_BEFORE_NAMESPACE();
namespace hybridrt {
namespace HWY_NAMESPACE {

/// Begins with the samples of `samples.pixels`, which see nothing yet. All else of the tile, which is empty, is hidden
/// by something at the eye, so that work is done for these only.
inline void begin_samples(DepthTile& tile, PixelSamples& samples) {
  constexpr float kAtEye = std::numeric_limits<float>::infinity();
  for (int i = 0; i < tile.height_px * kTileStride; i += kLanes) store(tile.lo + i, all(kAtEye));
  for (int b = 0; b < kBlocksX * kBlocksY; ++b) tile.block_stale[b] = true;
  const size_t size = samples.pixels.size() * kLongestVector;
  samples.lo.resize(size), samples.hi.resize(size), samples.triangle.resize(size);
  for (size_t i = 0; i < samples.pixels.size(); ++i) {
    const int place = (samples.pixels[i].y - tile.y_px) * kTileStride + samples.pixels[i].x - tile.x_px;
    tile.lo[place] = -1;
    tile.triangle[place] = static_cast<uint32_t>(i);
    for (int s = 0; s < kLongestVector; s += kLanes) {
      const Floats depth = hn::IfThenElse(first_lanes(samples.count - s), all(-1), all(kAtEye));
      const size_t at = i * kLongestVector + s;
      store(&samples.lo[at], depth), store(&samples.hi[at], depth);
      store_int(&samples.triangle[at], all_int(-1));
    }
  }
}

/// Samples triangles at all samples of a tile's pixels.
class PixelSampler {
 public:
  PixelSampler(DepthTile& tile, PixelSamples& samples)
      : tile_(tile), samples_(samples), vectors_((samples.count + kLanes - 1) / kLanes) {
    for (int v = 0; v < kVectors; ++v) used_[v] = first_lanes(samples.count - v * kLanes);
  }

  void sample(const HomogeneousTriangle& t, const PixelBox& box) {
    const EdgeTriangle edges = edges_in_box(t, box, tile_.x_px, tile_.y_px);
    if (!hides(tile_, edges.box, t.nearest)) sample(edges, std::nullopt, t.turn_known);
  }

  /// Looks for pixels whose samples may lie inside the triangle and in front, a pixel a lane. `turn_known`: see
  /// HomogeneousTriangle. Without `holes` no sample of a triangle with holes is certain.
  void sample(const EdgeTriangle& edges, const std::optional<HoleLanes>& holes, bool turn_known = true) {
    const PixelBox& box = edges.box;
    const SampledTriangle t(samples_, edges, holes);
    float reach[3];
    for (int k = 0; k < 3; ++k)
      reach[k] =
          edges.error[k] + (std::abs(edges.dx[k]) + std::abs(edges.dy[k])) * static_cast<float>(kSampleSpread_px);
    for (int y = box.y0; y <= box.y1; ++y)
      for (int x = box.x0; x <= box.x1; x += kLanes) {
        const Floats tile_lo = load(tile_.lo + y * kTileStride + x);
        Mask wanted = hn::AndNot(hn::Lt(all(edges.nearest), tile_lo), first_lanes(box.x1 - x + 1));
        if (hn::AllFalse(kFloats, wanted)) continue;
        if (turn_known)
          for (int k = 0; k < 3; ++k) {
            const float row = edges.dy[k] * static_cast<float>(y - box.y0) + edges.edge[k];
            const Floats from_x = lane_numbers() + all(static_cast<float>(x - box.x0));
            wanted = hn::And(wanted, hn::Gt(sum_of(all(edges.dx[k]), from_x, all(row)), all(-reach[k])));
          }
        for (uint32_t rest = bits_of(wanted); rest != 0; rest &= rest - 1) {
          const int at = x + __builtin_ctz(rest);
          if (turn_known)
            sample_pixel(t, at, y);
          else
            queue_pixel(t, at, y);
        }
      }
  }

 private:
  static constexpr int kVectors = kLongestVector / kLanes;

  /// How a linear function changes from a pixel to its samples.
  struct Steps {
    Floats to[kVectors];
    Steps(const PixelSamples& samples, float dx, float dy) {
      for (int v = 0; v < kVectors; ++v)
        to[v] = sum_of(all(dx), load(samples.x + v * kLanes), all(dy) * load(samples.y + v * kLanes));
    }
  };

  /// A triangle from pixel to pixel.
  struct SampledTriangle {
    const EdgeTriangle& edges;
    const std::optional<HoleLanes>& holes;
    Steps edge[3], depth;
    SampledTriangle(const PixelSamples& samples, const EdgeTriangle& t, const std::optional<HoleLanes>& holes_of_it)
        : edges(t),
          holes(holes_of_it),
          edge{{samples, t.dx[0], t.dy[0]}, {samples, t.dx[1], t.dy[1]}, {samples, t.dx[2], t.dy[2]}},
          depth(samples, t.depth_dx, t.depth_dy) {}
  };

  void sample_pixel(const SampledTriangle& t, int x, int y) {
    const EdgeTriangle& e = t.edges;
    const int place = y * kTileStride + x;
    const uint32_t first = tile_.triangle[place] * kLongestVector;
    const float from_x = static_cast<float>(x - e.box.x0), from_y = static_cast<float>(y - e.box.y0);
    Floats edge[3];
    for (int k = 0; k < 3; ++k) edge[k] = all(e.dx[k] * from_x + (e.dy[k] * from_y + e.edge[k]));
    const Floats depth = all(e.depth_dx * from_x + (e.depth_dy * from_y + e.depth)), depth_error = all(e.depth_error);
    bool nearer = false;
    for (int v = 0; v < vectors_; ++v) {
      Mask may = used_[v], certain = used_[v];
      for (int k = 0; k < 3; ++k) {
        const Floats value = edge[k] + t.edge[k].to[v];
        may = hn::And(may, hn::Gt(value, all(-e.error[k])));
        certain = hn::And(certain, hn::Gt(value, all(e.error[k])));
      }
      const size_t at = first + v * kLanes;
      const Floats depth_there = depth + t.depth.to[v];
      const Floats lo = depth_there - depth_error, hi = depth_there + depth_error;
      const Floats seen_lo = load(&samples_.lo[at]), seen_hi = load(&samples_.hi[at]);
      Mask visible = hn::AndNot(hn::Lt(hi, seen_lo), may);
      if (hn::AllFalse(kFloats, visible)) continue;
      Mask sure = hn::And(visible, certain);
      if (e.has_holes)
        decide_holes(t.holes, all(from_x) + load(samples_.x + v * kLanes), all(from_y) + load(samples_.y + v * kLanes),
                     depth_there, sure, visible);
      sure = hn::And(sure, hn::Lt(seen_hi, lo));
      store(&samples_.lo[at], hn::IfThenElse(sure, lo, seen_lo));
      store(&samples_.hi[at], hn::IfThenElse(sure, hi, seen_hi));
      const Ints triangle = all_int(static_cast<int>(e.triangle));
      store_int(&samples_.triangle[at],
                hn::IfThenElse(hn::RebindMask(kInts, sure), triangle, load_int(&samples_.triangle[at])));
      nearer |= !hn::AllFalse(kFloats, sure);
      queue_lanes(tile_, bits_of(hn::AndNot(sure, visible)), static_cast<uint32_t>(at), e.triangle,
                  hn::Min(hi, all(e.nearest)));
    }
    if (!nearer) return;
    Floats least = load(&samples_.lo[first]);
    for (int v = 1; v < vectors_; ++v) least = hn::Min(least, load(&samples_.lo[first + v * kLanes]));
    tile_.lo[place] = smallest(least);
  }

  /// Queues all samples of the pixel that are not certainly missed: of a triangle whose turn is unknown, and so all
  /// signs.
  void queue_pixel(const SampledTriangle& t, int x, int y) {
    const EdgeTriangle& e = t.edges;
    const size_t first = size_t{tile_.triangle[y * kTileStride + x]} * kLongestVector;
    for (int v = 0; v < vectors_; ++v) {
      Mask positive = used_[v], negative = used_[v];
      for (int k = 0; k < 3; ++k) {
        const float row = e.dy[k] * static_cast<float>(y - e.box.y0) + e.edge[k];
        const Floats value = all(e.dx[k] * static_cast<float>(x - e.box.x0) + row) + t.edge[k].to[v];
        positive = hn::And(positive, hn::Gt(value, all(-e.error[k])));
        negative = hn::And(negative, hn::Lt(value, all(e.error[k])));
      }
      queue_lanes(tile_, bits_of(hn::Or(positive, negative)), static_cast<uint32_t>(first + v * kLanes), e.triangle,
                  all(e.nearest));
    }
  }

  DepthTile& tile_;
  PixelSamples& samples_;
  const int vectors_;    ///< that hold a pixel's samples
  Mask used_[kVectors];  ///< their lanes
};

}  // namespace HWY_NAMESPACE
}  // namespace hybridrt
HWY_AFTER_NAMESPACE();

#endif
