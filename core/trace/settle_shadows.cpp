#include "core/trace/settle_shadows.h"

#include <array>

#include "core/base/check.h"
#include "core/trace/primary_surface.h"
#include "shaders/shared.h"

namespace hybridrt {
namespace {

constexpr size_t kPixelsAChunk = 4096;

uint8_t mask_of(ShadowCertainty certainty) {
  switch (certainty) {
    case ShadowCertainty::lit: return HRT_MASK_LIT;
    case ShadowCertainty::shadow: return 0;
    case ShadowCertainty::inside: return HRT_MASK_MARKED | HRT_MASK_INSIDE;
    case ShadowCertainty::unsettled: break;
  }
  return HRT_MASK_MARKED;
}

}  // namespace

void settle_shadows(const TraceJob& job, ThreadPool& pool, std::span<const uint32_t> ids, std::span<uint8_t> mask) {
  HRT_CHECK(job.light_buffer && ids.size() == mask.size());
  const auto width = static_cast<size_t>(job.view.width_px);
  parallel_for(pool, ids.size(), kPixelsAChunk, [&](size_t begin, size_t end) {
    std::vector<ShadowQuery> queries;
    std::vector<size_t> pixels;
    for (size_t i = begin; i < end; ++i) {
      mask[i] = ids[i] == kNoTriangle ? HRT_MASK_NO_RECEIVER : 0;
      if (ids[i] == kNoTriangle) continue;
      const dvec3 dir = glm::normalize(job.view.pixel_dir(static_cast<int>(i % width), static_cast<int>(i / width)));
      auto query = primary_shadow_query(job.scene, ids[i], job.view.eye, dir, job.light.toward);
      if (!query) continue;  // the unlit side
      query->anywhere = job.eye_enclosed;
      queries.push_back(*query);
      pixels.push_back(i);
    }
    std::vector<ShadowCertainty> certainties(queries.size());
    certify(*job.light_buffer, queries, certainties);
    for (size_t i = 0; i < pixels.size(); ++i) mask[pixels[i]] = mask_of(certainties[i]);
  });
}

}  // namespace hybridrt
