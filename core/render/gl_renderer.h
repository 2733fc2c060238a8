#pragma once

#include <deque>
#include <optional>

#include "core/base/parallel.h"
#include "core/gl/context.h"
#include "core/passes_gl/id_buffer.h"
#include "core/passes_gl/mark_boundary.h"
#include "core/passes_gl/shade.h"
#include "core/passes_gl/shadow_map.h"
#include "core/raster/visibility.h"
#include "core/render/edge_samples.h"
#include "core/render/frame_slot.h"
#include "core/render/kept_light_buffers.h"
#include "core/render/visible_receivers.h"
#include "core/trace/ray_caster.h"

namespace hybridrt {

/// The paper's five passes over a sequence. With one frame in flight, passes run one after the other; with more, pass 4
/// of a frame runs on the thread pool while the GL thread draws its neighbours (section 3.5, figure 4). The pictures
/// are the same. Must be used on the thread that the context is current on.
class GlRenderer {
 public:
  /// Every frame must have `light_count` lights. `caster` may be null if !needs_caster(). All arguments must
  /// outlive the renderer. Throws Error(device) when a size is over the device's limits.
  GlRenderer(const gl::Context& context, const gl::ShaderSources& shaders, const Scene& scene, const SceneFacts& facts,
             const Sheets& sheets, const RenderSettings& settings, size_t light_count, const RayCaster<float>* caster,
             ThreadPool& pool);
  ~GlRenderer();

  void render(const NextFrame& next, const DeliverFrame& deliver);

 private:
  void rasterize(FrameSlot& slot);           ///< passes 1-3, starts the readback and waits for it
  void update_shadow_maps(FrameSlot& slot);  ///< after its ids
  void test_shadows(FrameSlot& slot);        ///< pass 2's second step
  void mark_boundaries(FrameSlot& slot);     ///< pass 3 on the GPU
  void trace(FrameSlot& slot);               ///< pass 4; any thread
  double upload(FrameSlot& slot);            ///< pass 4's results; returns this thread's milliseconds
  Frame shade(FrameSlot& slot);              ///< pass 5; waits for pass 4
  Frame make_frame(FrameSlot& slot) const;   ///< from the downloaded picture

  const gl::Functions& gl_;
  const Scene& scene_;
  const RenderSettings settings_;
  const RayCaster<float>* caster_;
  ThreadPool& pool_;
  const SceneFacts& facts_;
  const size_t light_count_;

  SceneGpu scene_gpu_;
  ShadowMapPass shadow_map_pass_;
  IdBufferPass id_pass_;
  ShadowTestPass shadow_test_pass_;
  MarkBoundaryPass mark_pass_;
  ShadePass shade_pass_;

  const PixelRect part_;  ///< the part of the frame that is rendered

  // Used within one stage only, so one of each serves all slots.
  gl::Texture depth_, row_sums_, picture_;
  gl::TextureArray unmarked_mask_;
  gl::Readback picture_readback_;

  // The lights' structures, each kept while its light stands still; a warped shadow map also needs the camera to stand
  // still, and is fitted to the first sample of a frame for all of them.
  struct KeptShadowMap {
    std::optional<LightFrame> light;  ///< the light that it was drawn for
    View view;
    ShadowMapFit fit;
    gl::Texture depth;
    gl::Framebuffer target;
  };
  std::vector<KeptShadowMap> shadow_maps_;
  std::optional<VisibleReceivers> receivers_;  ///< for warped maps
  KeptLightBuffers light_buffers_;
  EdgeMemory edge_memory_;

  Clusters clusters_;  ///< for repairing ids; empty if settings ask for no repair
  RasterMemory raster_memory_;

  std::deque<FrameSlot> slots_;
};

}  // namespace hybridrt
