#pragma once

#include <span>

#include "core/base/parallel.h"
#include "core/trace/ray_caster.h"
#include "core/trace/trace_job.h"

namespace hybridrt {

/// Pass 4's arrays, one element per pixel, rows from the top; `mask` and `lit` one per pixel and light, light after
/// light. Bits of the masks: shaders/shared.h.
struct TracePixels {
  std::span<const uint32_t> ids;  ///< triangle seen, or kNoTriangle
  std::span<const uint8_t> mask;  ///< from pass 3; empty: every receiver asks a shadow ray
  std::span<uint8_t> lit;         ///< out: HRT_MASK_LIT or 0, for lights that cast shadows; empty: not wanted
  std::span<vec4> traced;         ///< out: light of reflected and refracted rays; empty: not wanted
};

/// Pass 4 (paper, section 3.4): goes through the pixels in tiles, each on one thread, nothing shared. Asks shadow rays
/// where pixels are marked; follows reflected and refracted rays, generation by generation, where the material sends
/// them. `caster` may be null if light buffers answer all shadow rays and nothing scatters. The result is the same for
/// any number of threads.
TraceStats trace_pass(const TraceJob& job, const RayCaster<float>* caster, ThreadPool& pool, const TracePixels& pixels);

/// Traces a whole frame on the CPU: primary rays, shadow rays if `job.shadows`, and all generations after them.
/// `picture` is linear, its alpha one of HRT_ALPHA_*; `lit` as in TracePixels, for all lights. Real = double
/// is the reference.
template <typename Real>
struct TracedFrame {
  std::span<vec4> picture;
  std::span<uint32_t> ids;
  std::span<uint8_t> lit;
};
template <typename Real>
TraceStats trace_frame(const TraceJob& job, const RayCaster<Real>& caster, ThreadPool& pool,
                       const TracedFrame<Real>& frame);

}  // namespace hybridrt
