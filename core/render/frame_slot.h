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

/// What one frame in flight owns: the paper's doubled camera, light and framebuffer. Pass 4 writes the
/// CPU arrays on other threads while the GL thread works on another slot.
struct FrameSlot {
  FrameSlot(const gl::Functions& gl, const RenderSettings& settings, size_t light_count, const gl::Texture& depth);

  FramePlan plan;

  gl::Texture ids;        ///< R32UI
  gl::TextureArray mask;  ///< R8UI, of pass 2 or 3, a layer a light
  gl::TextureArray lit;   ///< R8UI, of pass 4, a layer a light
  gl::Texture traced;     ///< RGBA32F, of pass 4
  gl::Framebuffer id_target;
  gl::Readback ids_readback, mask_readback;
  std::vector<gl::TimerQuery> timers;  ///< by PassId

  std::vector<uint32_t> repaired_ids;
  std::vector<uint8_t> settled_mask;  ///< of pass 3 on the CPU, light after light
  UnsettledShadows unsettled;
  std::vector<uint8_t> lit_pixels;  ///< light after light
  std::vector<vec4> traced_pixels;
  TraceStats stats;
  double trace_ms = 0, light_buffer_ms = 0, settle_ms = 0, repair_ms = 0;
  bool repaired = false;                 ///< pass 4 has been there
  std::shared_future<void> traced_done;  ///< pass 4, when it runs beside the GL thread

  gl::TimerQuery& timer(PassId pass) { return timers[static_cast<size_t>(pass)]; }
  std::span<const uint32_t> read_ids() const;  ///< of pass 2, or repaired as soon as they are
  std::span<const uint8_t> read_mask() const;  ///< of pass 2 or 3; empty when the plan has none
};

}  // namespace hybridrt
