#pragma once

#include <cstdint>
#include <vector>

#include "core/trace/ray_caster.h"
#include "core/trace/trace_job.h"

namespace hybridrt {

/// Shadow rays toward one light that wait to be asked together.
template <typename Real>
struct ShadowQueue {
  std::vector<ShadowQuery> queries;  ///< for the light's buffer, or
  std::vector<Ray<Real>> rays;       ///< for the caster where it has none
  std::vector<size_t> owners;        ///< of each question; whose they are is the asker's business
  std::vector<uint8_t> occluded;     ///< of each question, after answer()

  void clear() {
    queries.clear();
    rays.clear();
    owners.clear();
  }

  /// `caster` may be null where the light has a buffer.
  void answer(const TracedLight& light, const RayCaster<Real>* caster) {
    occluded.resize(owners.size());
    if (light.buffer)
      shadow_answers(*light.buffer, queries, occluded);
    else if (!rays.empty())
      caster->any_hits(rays, occluded);
  }
};

}  // namespace hybridrt
