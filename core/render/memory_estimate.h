#pragma once

#include <cstddef>
#include <cstdint>

#include "core/mesh/topology.h"
#include "core/render/frame_plan.h"
#include "core/trace/sheets.h"

namespace hybridrt {

/// Bytes that a run will hold, estimated before it starts. Drivers add their own.
struct MemoryEstimate {
  size_t scene = 0;        ///< the arrays of Scene
  size_t topology = 0;     ///< how its triangles are connected: components and sheets
  size_t gpu_scene = 0;    ///< the scene's copy for the GPU; 0 for methods without GL
  size_t gpu_frames = 0;   ///< textures and readback buffers of all frames in flight, and the shadow maps
  size_t frames = 0;       ///< what the CPU keeps of them
  size_t pictures = 0;     ///< pictures that wait to be written, at most
  size_t accelerator = 0;  ///< structures for rays and the CPU's rasterisers, light buffers included; rough

  size_t total() const { return scene + topology + gpu_scene + gpu_frames + frames + pictures + accelerator; }
};

/// What pictures may hold that wait to be written or are being written (WriteQueue): one for each thread and two that
/// wait, or up to 64 MiB, so that the disk may pause without holding up the renderer; not more than 64 of them, so that
/// a signal, after which they are still written, does not take long.
uint64_t most_written_bytes(const RenderSettings& settings, int threads);

/// The part that is known without a scene: gpu_frames, frames and pictures, for a sequence of `frame_count`.
MemoryEstimate estimate_frame_memory(const RenderSettings& settings, size_t light_count, int threads,
                                     int64_t frame_count);

MemoryEstimate estimate_memory(const Scene& scene, const SceneFacts& facts, const Topology& topology,
                               const Sheets& sheets, const RenderSettings& settings, size_t light_count,
                               bool light_moves, int threads, int64_t frame_count);

/// Throws Error (usage), saying what to do, if the frames and a contact sheet of `sheet_bytes` need more than
/// `most_bytes`. GPU memory counts too: a
/// software GL keeps it in main memory.
void require_room_for_frames(const RenderSettings& settings, size_t light_count, int threads, int64_t frame_count,
                             uint64_t sheet_bytes, uint64_t most_bytes);

}  // namespace hybridrt
