#pragma once

#include <span>
#include <vector>

#include "core/base/parallel.h"
#include "core/scene/scene.h"

namespace hybridrt {

/// How far two surfaces are from each other, sampled: the two-sided Hausdorff distance, and how much of what is allowed
/// it is.
struct SurfaceDistance {
  double from_original = 0;      ///< of samples of the original to the other surface, the largest; scene units
  double from_simplified = 0;    ///< the other way
  double share = 0;              ///< the largest of distance / bound; above 1 the bound is not kept
  size_t samples = 0;            ///< on both together
  std::vector<uint8_t> exceeds;  ///< by triangle of the original: 1 where the surface that stands for it is too far off

  double hausdorff() const { return from_original > from_simplified ? from_original : from_simplified; }
};

/// Samples lie on triangular grids: each triangle's corners, thirds of its edges and middle, and more where that is
/// less than one in an `area_samples`-th of the surface's area. `bounds`: one a triangle of `original`, scene units;
/// what holds for a point of `simplified` is the largest bound at the vertices of the original triangle that is nearest
/// to it. The spaces of both scenes must be the same. Rounding of float coordinates counts as 0. Source: Cignoni,
/// Rocchini and Scopigno, Metro: Measuring Error on Simplified Surfaces, 1998.
SurfaceDistance measure_distance(const Scene& original, std::span<const float> bounds, const Scene& simplified,
                                 ThreadPool& pool, double area_samples = 5e5);

}  // namespace hybridrt
