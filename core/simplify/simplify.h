#pragma once

#include "core/simplify/decimate.h"
#include "core/simplify/surface_distance.h"

namespace hybridrt {

struct Simplified {
  Scene scene;
  SurfaceDistance distance;  ///< from the original, measured
  int rounds = 0;            ///< of decimating and measuring
};

/// Decimates (decimate.h) a little within the bounds and measures; where one is not kept it is halved for the next
/// round, which begins with the original again, and after a few rounds the triangles there are left as they are. Throws
/// CheckFailed where a bound is still not kept, and unless each closed component is a closed one after as before. Where
/// `stop` says so, what is there is returned without a measurement.
Simplified simplify(const Scene& scene, const Topology& topology, std::span<const float> bounds, ThreadPool& pool,
                    const std::function<bool()>& stop = {});

}  // namespace hybridrt
