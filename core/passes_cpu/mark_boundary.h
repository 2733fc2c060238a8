#pragma once

#include "core/base/parallel.h"
#include "core/trace/trace_job.h"

namespace hybridrt {

/// The queries that pass 3 leaves to pass 4.
struct MarkedShadows {
  struct Chunk {
    std::vector<ShadowQuery> queries;
    std::vector<uint32_t> pixels;  ///< the pixel of each query
  };
  std::vector<Chunk> chunks;  ///< each of neighbouring pixels, light after light; kept to reuse their memory
};

/// What a cell says of a pixel, as bits of the mask (shaders/shared.h).
uint8_t mask_of(CellAnswer answer);

/// Pass 3 of `--shadows exact` (the paper's pass 3 guesses: passes_gl/mark_boundary.h). Where a cell of the light
/// buffer answers for all points in it (CellAnswer), the pixel has its answer. The others are marked for pass 4, and so
/// are pixels whose query may start inside a closed body. `ids`: one element per pixel, rows from the top; `mask` and
/// `lit`: one per light and pixel, light after light. Written: `mask` (bits of shaders/shared.h), `lit` (HRT_MASK_LIT
/// or 0; 0 where marked), `marked`. Lights that cast shadows must have their buffers; what is written for the others is
/// meaningless.
void mark_boundary(const TraceJob& job, ThreadPool& pool, std::span<const uint32_t> ids, std::span<uint8_t> mask,
                   std::span<uint8_t> lit, MarkedShadows& marked);

/// Pass 4 of the marked pixels: writes what is still missing in `lit`. Returns the ray counts and their time.
TraceStats answer_marked(const TraceJob& job, ThreadPool& pool, const MarkedShadows& marked, std::span<uint8_t> lit);

}  // namespace hybridrt
