#include "core/trace/settle_shadows.h"

#include <mutex>

#include "core/base/check.h"
#include "core/trace/primary_surface.h"
#include "core/trace/ray_generations.h"
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

void settle_shadows(const TraceJob& job, ThreadPool& pool, std::span<const uint32_t> ids, std::span<uint8_t> mask,
                    std::span<uint8_t> lit, UnsettledShadows& unsettled) {
  HRT_CHECK(job.light_buffer && ids.size() == mask.size() && ids.size() == lit.size());
  const auto width = static_cast<size_t>(job.view.width_px);
  unsettled.chunks.resize((ids.size() + kPixelsAChunk - 1) / kPixelsAChunk);
  parallel_for(pool, ids.size(), kPixelsAChunk, [&](size_t begin, size_t end) {
    auto& [queries, pixels] = unsettled.chunks[begin / kPixelsAChunk];
    queries.clear(), pixels.clear();
    for (size_t i = begin; i < end; ++i) {
      mask[i] = ids[i] == kNoTriangle ? HRT_MASK_NO_RECEIVER : 0;
      lit[i] = 0;
      if (ids[i] == kNoTriangle) continue;
      const dvec3 dir = glm::normalize(job.view.pixel_dir(static_cast<int>(i % width), static_cast<int>(i / width)));
      auto query = primary_shadow_query(job.scene, ids[i], job.view.eye, dir, job.light.toward);
      if (!query) continue;  // the unlit side
      query->anywhere = job.eye_enclosed;
      queries.push_back(*query);
      pixels.push_back(static_cast<uint32_t>(i));
    }
    std::vector<ShadowCertainty> certainties(queries.size());
    certify(*job.light_buffer, queries, certainties);
    size_t kept = 0;
    for (size_t i = 0; i < pixels.size(); ++i) {
      mask[pixels[i]] = mask_of(certainties[i]);
      lit[pixels[i]] = mask[pixels[i]] & HRT_MASK_LIT;
      if (!(mask[pixels[i]] & HRT_MASK_MARKED)) continue;
      queries[kept] = queries[i];
      pixels[kept++] = pixels[i];
    }
    queries.resize(kept);
    pixels.resize(kept);
  });
}

TraceStats answer_unsettled(const TraceJob& job, ThreadPool& pool, const UnsettledShadows& unsettled,
                            std::span<uint8_t> lit) {
  TraceStats total;
  std::mutex mutex;
  pool.run(unsettled.chunks.size(), [&](size_t chunk, int) {
    const auto& [queries, pixels] = unsettled.chunks[chunk];
    const double started_ms = thread_cpu_ms();
    std::vector<uint8_t> occluded(queries.size());
    shadow_answers(*job.light_buffer, queries, occluded);
    for (size_t i = 0; i < pixels.size(); ++i) lit[pixels[i]] = occluded[i] ? 0 : HRT_MASK_LIT;
    TraceStats stats;
    stats.pixels_marked = stats.shadow_rays = stats.primary_shadow_rays = static_cast<int64_t>(queries.size());
    stats.shadow_cpu_ms = thread_cpu_ms() - started_ms;
    std::lock_guard lock(mutex);
    total.add(stats);
  });
  return total;
}

}  // namespace hybridrt
