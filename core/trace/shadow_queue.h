#pragma once

#include <cstdint>
#include <vector>

#include "core/trace/ray_caster.h"
#include "core/trace/trace_job.h"

namespace hybridrt {

/// Shadow rays toward one light, to be asked together.
template <typename Real>
struct ShadowQueue {
  std::vector<ShadowQuery> queries;  ///< for the light's buffer, if it has one
  std::vector<Ray<Real>> rays;       ///< for the caster otherwise
  std::vector<size_t> owners;        ///< per query: an index of the caller's choice
  std::vector<uint8_t> occluded;     ///< per query, after answer()

  void clear() {
    queries.clear();
    rays.clear();
    owners.clear();
  }

  /// `caster` may be null if the light has a buffer.
  void answer(const TracedLight& light, const RayCaster<Real>* caster) {
    occluded.resize(owners.size());
    if (light.buffer)
      shadow_answers(*light.buffer, queries, occluded);
    else if (!rays.empty())
      caster->any_hits(rays, occluded);
  }
};

}  // namespace hybridrt
