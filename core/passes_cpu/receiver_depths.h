#pragma once

#include <span>

#include "core/base/parallel.h"
#include "core/scene/scene.h"
#include "core/scene/view.h"

namespace hybridrt {

/// Before pass 1, if its map is fitted to what is seen: the nearest and the farthest depth (near / distance along the
/// view, at most 1) per block of pixels, as receiver_hull() reads them. `ids`: triangle seen, or kNoTriangle; one per
/// pixel of the view, rows from the top. `blocks`: receiver_blocks(width) by receiver_blocks(height); (0, 2) where
/// nothing is seen.
void receiver_depths(const Scene& scene, const View& view, double near_distance, std::span<const uint32_t> ids,
                     ThreadPool& pool, std::span<vec2> blocks);

}  // namespace hybridrt
