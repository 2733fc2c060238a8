#pragma once

#include <functional>
#include <span>
#include <vector>

#include "core/base/math.h"
#include "core/base/parallel.h"
#include "core/image/image.h"
#include "core/trace/tile.h"

namespace hybridrt {

/// Takes a sample, by its number (sample_offset_px), of some pixels: linear colours, and alpha 1 where a surface is
/// seen, else 0. The pixels of a tile of the rasteriser follow one another, and so do those of a Tile's block.
using TakeSample = std::function<void(int sample, std::span<const PixelAt> pixels, std::span<vec4> colors)>;

struct EdgeSampling {
  int samples = 1;            ///< of a pixel near an edge
  bool retake_first = false;  ///< the picture's samples stand for whole pixels, not for a part (View::samples)
};

/// Kept from picture to picture.
struct EdgeMemory {
  std::vector<uint8_t> sampled;    ///< by pixel: 1 if all its samples are taken, or wanted
  std::vector<PixelAt> pixels;     ///< at hand
  std::vector<vec4> colors, sums;  ///< of these pixels
};

/// Neighbours that contrast by more (see contrasts()) have an edge between them: ten of 255 display values.
inline constexpr float kEdgeContrast = 10.0f / 255;

/// Anti-aliasing where there are edges. `picture`: the first sample of each pixel. Pixels that contrast with a
/// neighbour become the mean of all samples. Where one of these contrasts with the neighbour on its side of the pixel,
/// that neighbour is sampled too, and so on: so what is thinner than a pixel is followed from wherever a centre meets
/// it. What no centre meets is missed. Each pixel is either its first sample or, bit for bit, what averaged() makes of
/// all of them; the first samples alone decide which. Returns the number of the latter.
int64_t sample_edges(Image& picture, const EdgeSampling& sampling, ThreadPool& pool, EdgeMemory& memory,
                     const TakeSample& take);

}  // namespace hybridrt
