#pragma once

#include <memory>

#include "core/scene/scene.h"
#include "core/trace/ray_caster.h"

namespace hybridrt {

/// One ray after another, or 16 consecutive rays of a batch together. Packets are faster nearly everywhere, even for
/// rays off curved mirrors, if a batch goes through the picture in blocks of 4 x 4 pixels (docs/results/trace.md).
enum class EmbreeRays { single, packets };

/// Embree 3 behind the same interface: robust intersections, high build quality. The build uses up to `threads` >= 1
/// threads. Zero-area triangles are left out, as in the kd-tree; of triangles with the same corners NearestHit's is
/// reported; of other hits at the same t any may be. Not quite watertight: about one in 600 rays aimed exactly at a
/// vertex slips through (Embree 3.13.5). Needs t_min >= 0 and coordinates below 1e18. The scene is copied (its textures
/// are shared, if they have holes) and need not outlive the caster. Throws Error (device) with Embree's own message,
/// std::bad_alloc.
std::unique_ptr<RayCaster<float>> make_embree_caster(const Scene& scene, int threads,
                                                     EmbreeRays going = EmbreeRays::packets);

}  // namespace hybridrt
