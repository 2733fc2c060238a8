#include "core/passes_cpu/mark_boundary.h"

#include <mutex>

#include "core/base/check.h"
#include "core/base/timing.h"
#include "core/trace/primary_surface.h"
#include "core/trace/ray_generations.h"
#include "core/trace/tile.h"
#include "shaders/shared.h"

namespace hybridrt {

uint8_t mask_of(CellAnswer answer) {
  switch (answer) {
    case CellAnswer::lit: return HRT_MASK_LIT;
    case CellAnswer::shadow: return 0;
    case CellAnswer::inside: return HRT_MASK_MARKED | HRT_MASK_INSIDE;
    case CellAnswer::unknown: break;
  }
  return HRT_MASK_MARKED;
}

namespace {

/// Queries to one light that are asked together.
constexpr size_t kBatch = 256;

/// Asks the light buffer's cells a batch of queries, marks those that they cannot answer, keeps these and empties the
/// batch. `mask` and `lit`: the light's.
void mark_batch(const LightBuffer& buffer, MarkedShadows::Chunk& asked, std::span<uint8_t> mask, std::span<uint8_t> lit,
                MarkedShadows::Chunk& marked) {
  CellAnswer answers[kBatch];
  answers_of_cells(buffer, asked.queries, {answers, asked.queries.size()});
  for (size_t i = 0; i < asked.pixels.size(); ++i) {
    const uint32_t pixel = asked.pixels[i];
    mask[pixel] = mask_of(answers[i]);
    lit[pixel] = mask[pixel] & HRT_MASK_LIT;
    if (!(mask[pixel] & HRT_MASK_MARKED)) continue;
    marked.queries.push_back(asked.queries[i]);
    marked.pixels.push_back(pixel);
  }
  asked.queries.clear(), asked.pixels.clear();
}

}  // namespace

void mark_boundary(const TraceJob& job, ThreadPool& pool, std::span<const uint32_t> ids, std::span<uint8_t> mask,
                   std::span<uint8_t> lit, MarkedShadows& marked) {
  const size_t lights = job.lights.size(), pixel_count = ids.size();
  HRT_CHECK(lights * pixel_count == mask.size() && mask.size() == lit.size());
  const int width = job.view.width_px;
  const size_t chunk_pixels = static_cast<size_t>(width) * Tile::kBlock_px;
  const size_t chunks = (pixel_count + chunk_pixels - 1) / chunk_pixels;
  marked.chunks.resize(lights * chunks);
  parallel_for(pool, pixel_count, chunk_pixels, [&](size_t begin, size_t end) {
    std::vector<MarkedShadows::Chunk> asked(lights);
    const auto mark_asked = [&](size_t l) {
      mark_batch(*job.lights[l].buffer, asked[l], mask.subspan(l * pixel_count, pixel_count),
                 lit.subspan(l * pixel_count, pixel_count), marked.chunks[l * chunks + begin / chunk_pixels]);
    };
    for (size_t l = 0; l < lights; ++l) {
      MarkedShadows::Chunk& chunk = marked.chunks[l * chunks + begin / chunk_pixels];
      chunk.queries.clear(), chunk.pixels.clear();
      for (size_t i = begin; i < end; ++i) {
        mask[l * pixel_count + i] = ids[i] == kNoTriangle ? HRT_MASK_NO_RECEIVER : 0;
        lit[l * pixel_count + i] = 0;
      }
    }
    const Tile rows{0, static_cast<int>(begin / width), width, static_cast<int>(end / width)};
    rows.for_each_pixel_in_blocks([&](int x, int y, uint32_t place) {
      const size_t i = begin + place;
      if (ids[i] == kNoTriangle) return;
      const dvec3 dir = glm::normalize(job.view.pixel_dir(x, y));
      for_each_facing_light(job.scene, ids[i], job.view.eye, dir, job.lights, [&](size_t l, const ShadowQuery& query) {
        if (!job.casts_shadow(l)) return;
        asked[l].queries.push_back(query);
        asked[l].queries.back().anywhere = job.eye_enclosed;
        asked[l].pixels.push_back(static_cast<uint32_t>(i));
        if (asked[l].pixels.size() == kBatch) mark_asked(l);
      });
    });
    for (size_t l = 0; l < lights; ++l)
      if (job.casts_shadow(l)) mark_asked(l);
  });
}

TraceStats answer_marked(const TraceJob& job, ThreadPool& pool, const MarkedShadows& marked, std::span<uint8_t> lit) {
  TraceStats total;
  std::mutex mutex;
  if (job.lights.empty()) return total;
  const size_t chunks = marked.chunks.size() / job.lights.size(), pixel_count = lit.size() / job.lights.size();
  pool.run(marked.chunks.size(), [&](size_t chunk, int) {
    const auto& [queries, pixels] = marked.chunks[chunk];
    if (queries.empty()) return;
    const size_t light = chunk / chunks;
    const double started_ms = thread_cpu_ms();
    std::vector<uint8_t> occluded(queries.size());
    shadow_answers(*job.lights[light].buffer, queries, occluded);
    for (size_t i = 0; i < pixels.size(); ++i) lit[light * pixel_count + pixels[i]] = occluded[i] ? 0 : HRT_MASK_LIT;
    TraceStats stats;
    stats.pixels_marked = stats.shadow_rays = stats.primary_shadow_rays = static_cast<int64_t>(queries.size());
    stats.shadow_cpu_ms = thread_cpu_ms() - started_ms;
    std::lock_guard lock(mutex);
    total.add(stats);
  });
  return total;
}

}  // namespace hybridrt
