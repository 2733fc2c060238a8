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
/// vertex slips through (Embree 3.13.5). Needs t_min >= 0 and coordinates below 1e18. The scene's positions and
/// triangles are lent to Embree: the scene must outlive the caster and stay as it is, though it may be moved. Throws
/// Error (device) with Embree's own message, std::bad_alloc.
///
/// Why not RTC_SCENE_FLAG_COMPACT, with 35 bytes per triangle instead of 73: rays took a sixth longer, and in one test
/// rtcOccluded16 did not return, three times out of three, after many other tests in the same process. That was before
/// lanes without a ray were emptied; it has not been tried since.
std::unique_ptr<RayCaster<float>> make_embree_caster(const Scene& scene, int threads,
                                                     EmbreeRays going = EmbreeRays::packets);

}  // namespace hybridrt
