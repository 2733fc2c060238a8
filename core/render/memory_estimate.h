#pragma once

#include <cstddef>

#include "core/render/frame_plan.h"

namespace hybridrt {

/// Bytes that a run will hold, known before it starts. Drivers add their own.
struct MemoryEstimate {
  size_t scene = 0;        ///< the arrays of Scene
  size_t gpu_scene = 0;    ///< their copies for the GPU; 0 for methods without GL
  size_t gpu_frames = 0;   ///< textures and readback buffers of all frames in flight, and the shadow map
  size_t accelerator = 0;  ///< of rays, the light's too; rough; 0 when no frame can need any
};

MemoryEstimate estimate_memory(const Scene& scene, const SceneFacts& facts, const RenderSettings& settings,
                               Accel accel, bool light_moves);

}  // namespace hybridrt
