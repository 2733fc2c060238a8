#pragma once

#include "core/trace/hit_surfaces.h"
#include "core/trace/trace_job.h"

namespace hybridrt {

/// The colour of each surface, without what it reflects and refracts. `lit`: one per surface, bit l where light l
/// arrives. In single precision many surfaces at once, as pass 5 shades; in double precision one by one.
void shade_hits(const TraceJob& job, const HitSurfaces<float>& hits, const uint8_t* lit,
                float (&colors)[3][HitSurfaces<float>::kRoom]);
void shade_hits(const TraceJob& job, const HitSurfaces<double>& hits, const uint8_t* lit,
                double (&colors)[3][HitSurfaces<double>::kRoom]);

}  // namespace hybridrt
