#pragma once

#include <array>
#include <cstdint>
#include <future>
#include <span>
#include <vector>

#include "core/gl/readback.h"
#include "core/gl/timer_query.h"
#include "core/passes_cpu/mark_boundary.h"
#include "core/render/frame.h"
#include "core/render/frame_plan.h"
#include "core/render/frame_timings.h"

namespace hybridrt {

/// Results of passes 3 and 4 other than pixels.
struct CpuResults {
  TraceStats stats;
  double trace_ms = 0, light_buffer_ms = 0, mark_ms = 0;
};

/// What one frame in flight owns: the paper doubles camera, light and framebuffer. Pass 4 writes the CPU arrays on
/// other threads while the GL thread works on another slot.
struct FrameSlot {
  FrameSlot(const gl::Functions& gl, const RenderSettings& settings, size_t light_count, const gl::Texture& depth);

  FramePlan plan;

  gl::Texture ids;        ///< R32UI
  gl::TextureArray mask;  ///< R8UI, from pass 2 or 3, a layer per light
  gl::TextureArray lit;   ///< R8UI, from pass 4, a layer per light
  gl::Texture traced;     ///< RGBA32F, from pass 4
  gl::Framebuffer id_target;
  gl::Readback ids_readback, mask_readback;
  std::vector<gl::TimerQuery> timers;  ///< by PassId

  // Memory for passes 3 and 4, kept from frame to frame.
  std::vector<uint32_t> repaired_ids;
  std::vector<uint8_t> marked_mask;  ///< from pass 3 on the CPU, light after light
  MarkedShadows marked;
  std::vector<uint8_t> lit_pixels;  ///< light after light
  std::vector<vec4> traced_pixels;
  CpuResults cpu;
  std::shared_future<void> traced_done;  ///< pass 4, when it runs beside the GL thread

  /// Prepares the slot for another frame: clears all results of the previous one.
  void begin(FramePlan next);

  gl::TimerQuery& timer(PassId pass) { return timers[static_cast<size_t>(pass)]; }
  std::span<const uint32_t> rasterised_ids() const;  ///< from pass 2, read back; empty if the plan reads none
  std::span<const uint32_t> seen_ids() const;        ///< the same, repaired if the plan repairs
  std::span<const uint8_t> read_mask() const;        ///< from pass 2 or 3; empty if the plan has none
};

}  // namespace hybridrt
