#pragma once

#include "core/base/parallel.h"
#include "core/gl/context.h"
#include "core/passes/id_buffer.h"
#include "core/passes/mark_boundary.h"
#include "core/passes/shade.h"
#include "core/passes/shadow_map.h"
#include "core/render/frame_slot.h"
#include "core/render/kept_light_buffer.h"
#include "core/render/visible_receivers.h"
#include "core/trace/ray_caster.h"

#include <deque>
#include <optional>

namespace hybridrt {

/// True if some frame of the scene may need rays that no light buffer answers, so that a caster must be built.
bool needs_caster(const SceneFacts& facts, const RenderSettings& settings, bool light_moves);

/// The paper's five passes over a sequence. With one frame in flight, pass follows pass; with more, pass 4
/// of a frame runs on the thread pool while the GL thread draws its neighbours (section 3.5, figure 4). The
/// pictures are the same. Lives and renders on the thread that the context is current on.
class GlRenderer {
 public:
  /// `caster` may be null if !needs_caster(). Everything handed in must outlive the renderer.
  /// Throws Error(device) when a size is over the device's limits.
  GlRenderer(const gl::Context& context, const gl::ShaderSources& shaders, const Scene& scene,
             const RenderSettings& settings, const RayCaster<float>* caster, ThreadPool& pool);
  ~GlRenderer();

  void render(const NextFrame& next, const DeliverFrame& deliver);

 private:
  void rasterize(FrameSlot& slot);  ///< passes 1-3, starts the readback and waits for it
  void update_shadow_map(FrameSlot& slot);  ///< after its ids
  void trace(FrameSlot& slot);      ///< pass 4; any thread
  Frame shade(FrameSlot& slot);     ///< pass 5; waits for pass 4

  const gl::Functions& gl_;
  const Scene& scene_;
  const RenderSettings settings_;
  const RayCaster<float>* caster_;
  ThreadPool& pool_;
  const SceneFacts facts_;

  SceneGpu scene_gpu_;
  ShadowMapPass shadow_map_pass_;
  IdBufferPass id_pass_;
  ShadowTestPass shadow_test_pass_;
  MarkBoundaryPass mark_pass_;
  ShadePass shade_pass_;

  const PixelRect part_;  ///< of the frame, rendered

  // Used within one stage only, so one of each serves all slots.
  gl::Texture depth_, unmarked_mask_, row_sums_, picture_;
  gl::Readback picture_readback_;

  // The light's structures, kept while the light stands still, a warped shadow map while the camera does, too.
  std::optional<LightFrame> light_frame_;
  std::optional<VisibleReceivers> receivers_;  ///< for a warped map
  ShadowMapFit shadow_map_fit_;
  View shadow_map_view_;  ///< that a warped map is fitted to
  gl::Texture shadow_map_;
  gl::Framebuffer shadow_map_target_;
  KeptLightBuffer light_buffer_;

  std::deque<FrameSlot> slots_;
};

}  // namespace hybridrt
