#pragma once

#include "core/base/parallel.h"
#include "core/trace/trace_job.h"

namespace hybridrt {

/// The questions that pass 3 leaves to pass 4.
struct UnsettledShadows {
  struct Chunk {
    std::vector<ShadowQuery> queries;
    std::vector<uint32_t> pixels;  ///< of each query
  };
  std::vector<Chunk> chunks;  ///< of neighbouring pixels, light after light; kept from frame to frame for their memory
};

/// Pass 3 of `--shadows exact`, where the paper's pass 3 guesses: pixels whose shadow answer is certain get it, and
/// only the others are marked for pass 4. The proof comes from the light buffer's cells: see
/// ShadowCertainty. What may start inside a closed body is marked.
/// `ids`: one element a pixel, rows from the top; `mask` and `lit`: as many a light, light after light. Written: `mask`
/// (bits of shaders/shared.h), `lit` (HRT_MASK_LIT or 0; 0 where unsettled), `unsettled`. Lights that cast shadows must
/// have their buffers; what is written for the others means nothing.
void settle_shadows(const TraceJob& job, ThreadPool& pool, std::span<const uint32_t> ids, std::span<uint8_t> mask,
                    std::span<uint8_t> lit, UnsettledShadows& unsettled);

/// Pass 4's part of it: writes what is still missing in `lit`. Returns the counts of rays, and their time.
TraceStats answer_unsettled(const TraceJob& job, ThreadPool& pool, const UnsettledShadows& unsettled,
                            std::span<uint8_t> lit);

}  // namespace hybridrt
