#pragma once

#include <memory>

#include "core/scene/scene.h"
#include "core/trace/ray_caster.h"

namespace hybridrt {

/// One after another, or 16 consecutive rays of a batch together. Packets win nearly everywhere, even on rays off
/// curved mirrors, when a batch goes through the picture in blocks of 4 x 4 pixels (docs/results/trace.md).
enum class EmbreeRays { single, packets };

/// Embree 3 behind the same interface: robust intersections, high build quality. `threads` >= 1 is how many
/// the build may use. Zero-area triangles are left out, as in the kd-tree; of several hits at the same t any
/// may be reported. Not quite watertight: of rays aimed exactly at a vertex about one in 600 slips through
/// (Embree 3.13.5). Needs t_min >= 0 and coordinates below 1e18. The scene is copied (its textures are
/// shared, if they have holes): it need not outlive the caster. Throws Error (device) with Embree's own message,
/// std::bad_alloc.
std::unique_ptr<RayCaster<float>> make_embree_caster(const Scene& scene, int threads,
                                                     EmbreeRays going = EmbreeRays::packets);

}  // namespace hybridrt
