#include "core/render/mapped_renderer.h"

#include "core/base/check.h"
#include "core/base/timing.h"
#include "core/passes_cpu/blur_boundary.h"
#include "core/passes_cpu/shadow_test.h"
#include "core/passes_cpu/trace_pass.h"
#include "core/render/aov.h"
#include "core/render/kept_light_buffers.h"
#include "core/render/kept_shadow_maps.h"
#include "core/render/shade_frame.h"

namespace hybridrt {
namespace {

class MappedRenderer {
 public:
  MappedRenderer(const Scene& scene, const SceneFacts& facts, const Sheets& sheets, const RenderSettings& settings,
                 const RayCaster<float>* caster, ThreadPool& pool)
      : scene_(scene),
        facts_(facts),
        settings_(settings),
        caster_(caster),
        pool_(pool),
        clusters_(make_clusters(scene, pool)),
        shadow_maps_(scene, clusters_, settings, pool),
        light_buffers_(scene, sheets, pool) {}

  Frame render(const FrameRequest& request) {
    const FramePlan plan = make_frame_plan(scene_, facts_, request, settings_);
    Frame frame;
    frame.number = plan.number;
    find_ids(plan, frame.timings);
    if (plan.shadow_map) test_by_maps(plan, frame.timings);
    if (plan.mark_blur) mark_boundaries(plan, frame.timings);
    TraceJob job = make_trace_job(scene_, plan, settings_);
    lit_.clear(), traced_.clear();
    if (plan.trace()) trace(plan, job, frame);
    shade(plan, job, frame);
    frame.aovs = make_aovs(scene_, plan.view, kept_of_rendered(settings_), {plan.lights, ids_, mask_, lit_, traced_},
                           settings_.aovs);
    return frame;
  }

 private:
  /// Pass 2's first step.
  void find_ids(const FramePlan& plan, FrameTimings& timings) {
    const Stopwatch rasterizing;
    ids_.resize(static_cast<size_t>(plan.view.width_px) * plan.view.height_px);
    rasterize_ids(scene_, clusters_, plan.view, pool_, raster_, ids_);
    timings[PassId::id] = rasterizing.elapsed_ms();
  }

  /// Pass 1, fitted to the ids, and pass 2's second step.
  void test_by_maps(const FramePlan& plan, FrameTimings& timings) {
    timings[PassId::shadow_map] = shadow_maps_.update(plan, ids_);
    const Stopwatch testing;
    mask_.resize(plan.lights.size() * ids_.size());
    for (size_t l = 0; l < plan.lights.size(); ++l)
      if (plan.casts_shadow(l)) {
        const KeptShadowMaps::Map& map = shadow_maps_.of(l);
        test_shadows({scene_, plan.view, plan.lights[l].toward, map.fit, settings_.shadow_map_px, map.depth, ids_},
                     pool_, mask_of(l));
      }
    timings[PassId::id] += testing.elapsed_ms();
  }

  /// Pass 3.
  void mark_boundaries(const FramePlan& plan, FrameTimings& timings) {
    const Stopwatch marking;
    for (size_t l = 0; l < plan.lights.size(); ++l)
      if (plan.casts_shadow(l)) blur_boundary(plan.view.width_px, settings_.blur_kernel_px, pool_, blur_, mask_of(l));
    timings[PassId::mark] = marking.elapsed_ms();
  }

  /// Pass 4.
  void trace(const FramePlan& plan, TraceJob& job, Frame& frame) {
    HRT_CHECK(caster_ || !(plan.trace_scattered || (plan.trace_shadows && !plan.light_buffers)));
    if (plan.light_buffers) frame.timings[PassId::shadow_map] += light_buffers_.answer(job);
    const Stopwatch tracing;
    if (plan.trace_shadows) lit_.resize(plan.lights.size() * ids_.size());
    if (plan.trace_scattered) traced_.resize(ids_.size());
    frame.stats = trace_pass(job, caster_, pool_, {ids_, mask_, lit_, traced_});
    frame.timings[PassId::trace] = tracing.elapsed_ms();
  }

  /// Pass 5.
  void shade(const FramePlan& plan, const TraceJob& job, Frame& frame) {
    const Stopwatch shading;
    const PixelRect kept = kept_of_rendered(settings_);
    frame.picture = Image::uninitialized(kept.width_px, kept.height_px, settings_.alpha ? 4 : 3);
    const std::span<const uint8_t> lit = plan.trace_shadows ? lit_ : mask_;
    shade_frame(job, pool_, {ids_, lit, traced_}, kept, frame.picture, frame.stats);
    frame.timings[PassId::shade] = shading.elapsed_ms();
  }

  std::span<uint8_t> mask_of(size_t light) { return std::span(mask_).subspan(light * ids_.size(), ids_.size()); }

  const Scene& scene_;
  const SceneFacts& facts_;
  const RenderSettings& settings_;
  const RayCaster<float>* caster_;
  ThreadPool& pool_;
  const Clusters clusters_;
  KeptShadowMaps shadow_maps_;
  KeptLightBuffers light_buffers_;

  // Of the frame at hand; memory is kept from frame to frame. Per light ones light after light.
  RasterMemory raster_;
  BlurMemory blur_;
  std::vector<uint32_t> ids_;
  std::vector<uint8_t> mask_, lit_;  ///< as the GL form's (shaders/shared.h); mask_ is empty if no light casts shadows
  std::vector<vec4> traced_;
};

}  // namespace

void render_mapped(const Scene& scene, const SceneFacts& facts, const Sheets& sheets, const RenderSettings& settings,
                   const RayCaster<float>* caster, ThreadPool& pool, const NextFrame& next,
                   const DeliverFrame& deliver) {
  MappedRenderer renderer(scene, facts, sheets, settings, caster, pool);
  render_each(next, deliver, [&](const FrameRequest& request) { return renderer.render(request); });
}

}  // namespace hybridrt
