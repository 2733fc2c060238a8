#pragma once

#include "core/base/parallel.h"
#include "core/trace/trace_job.h"

namespace hybridrt {

/// Pass 3 of `--shadows exact`, where the paper's pass 3 guesses: pixels whose shadow answer is certain get it, and
/// only the others are marked for pass 4. The proof comes from the light buffer's cells: nothing in the pixel's cell
/// is nearer to the light (lit), or one triangle nearer to the light covers the whole cell (shadow). What may start
/// inside a closed body is marked.
/// `ids` and `mask`: one element a pixel, rows from the top; `mask` is written, bits of shaders/shared.h.
/// `job.light_buffer` must be there.
void settle_shadows(const TraceJob& job, ThreadPool& pool, std::span<const uint32_t> ids, std::span<uint8_t> mask);

}  // namespace hybridrt
