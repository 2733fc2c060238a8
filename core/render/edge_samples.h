#pragma once

#include <algorithm>
#include <functional>
#include <span>
#include <vector>

#include "core/base/math.h"
#include "core/base/parallel.h"
#include "core/image/image.h"
#include "core/trace/tile.h"

namespace hybridrt {

struct EdgeSampling {
  int samples = 1;            ///< of a pixel near an edge
  bool retake_first = false;  ///< the picture's samples stand for whole pixels, not for a part (View::samples)

  int first_taken() const { return retake_first ? 0 : 1; }
  /// So many pixels are taken at once, so that their samples fit a cache.
  size_t pixels_at_once() const { return std::max(1, 32768 / samples); }
};

/// What `count` pixels show, from number `first` on: of each sample that is taken, by its number (sample_offset_px),
/// linear colours of all of these pixels, with alpha 1 where a surface is seen, else 0.
using GiveColors = std::function<void(size_t first, size_t count, std::span<const vec4> colors)>;

/// Takes the samples of some pixels, from EdgeSampling::first_taken() on, and gives all of them, from any thread. The
/// pixels of a tile of the rasteriser follow one another, and so do those of a Tile's block.
using TakeSamples = std::function<void(std::span<const PixelAt> pixels, const GiveColors& give)>;

/// Kept from picture to picture.
struct EdgeMemory {
  std::vector<uint8_t> sampled;  ///< by pixel: 1 if all its samples are taken, or wanted
  std::vector<PixelAt> pixels;   ///< at hand
  std::vector<vec4> sums;        ///< of these pixels
};

/// Neighbours that contrast by more (see contrasts()) have an edge between them: ten of 255 display values.
inline constexpr float kEdgeContrast = 10.0f / 255;

/// Anti-aliasing where there are edges. `picture`: the first sample of each pixel. Pixels that contrast with a
/// neighbour become the mean of all samples. Where one of these contrasts with the neighbour on its side of the pixel,
/// that neighbour is sampled too, and so on: so what is thinner than a pixel is followed from wherever a centre meets
/// it. What no centre meets is missed. Each pixel is either its first sample or, bit for bit, what averaged() makes of
/// all of them; the first samples alone decide which. Returns the number of the latter.
int64_t sample_edges(Image& picture, const EdgeSampling& sampling, ThreadPool& pool, EdgeMemory& memory,
                     const TakeSamples& take);

}  // namespace hybridrt
