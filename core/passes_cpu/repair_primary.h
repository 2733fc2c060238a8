#pragma once

#include "core/base/parallel.h"
#include "core/scene/scene.h"
#include "core/scene/view.h"
#include "core/trace/ray_caster.h"

namespace hybridrt {

/// Counts of repair_primary_hits.
struct RepairStats {
  int64_t suspects = 0;  ///< pixels that a ray checked
  int64_t repaired = 0;  ///< those that see another triangle than the rasterised one
};

/// Rasterisation snaps vertices to a fraction of a pixel, so about one pixel in two thousand names a triangle that its
/// centre misses, or one behind the triangle that its centre meets. Such pixels lie within that fraction of an edge.
/// Suspects are therefore pixels whose centre ray misses their triangle or passes near its outline, or meets the
/// triangle of one of the eight neighbours. A primary ray checks them, in double precision, against the pixel's and its
/// neighbours' triangles and the one that `caster` finds. `ids`: what pass 2 read back, rows from the top. `repaired`:
/// the same with suspects corrected; of several triangles at the same distance the smallest number, as in the
/// reference. Where triangles are so large that single precision misplaces them (misplaced_triangles()), every pixel is
/// a suspect.
RepairStats repair_primary_hits(const Scene& scene, const View& view, const RayCaster<float>& caster, ThreadPool& pool,
                                std::span<const uint32_t> ids, std::span<uint32_t> repaired);

}  // namespace hybridrt
