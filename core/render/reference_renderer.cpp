#include "core/render/reference_renderer.h"

#include "core/base/timing.h"
#include "core/passes_cpu/trace_pass.h"
#include "core/render/aov.h"
#include "core/render/kept_light_buffers.h"

namespace hybridrt {

void render_reference(const Scene& scene, const SceneFacts& facts, const Topology& topology,
                      const RenderSettings& settings, const RayCaster<double>& caster, ThreadPool& pool,
                      const NextFrame& next, const DeliverFrame& deliver) {
  const PixelRect part = rendered_rect(settings), kept = kept_of_rendered(settings);
  const size_t pixels = static_cast<size_t>(part.width_px) * part.height_px;
  std::vector<vec4> picture(pixels);
  std::vector<uint32_t> ids(pixels);
  std::vector<uint8_t> lit;

  KeptLightBuffers light_buffers(scene, topology, pool);
  render_each(next, deliver, [&](const FrameRequest& request) {
    const FramePlan plan = make_frame_plan(scene, facts, request, settings);
    TraceJob job = make_trace_job(scene, plan, settings);
    Frame frame;
    frame.number = plan.number;
    if (plan.light_buffers) frame.timings[PassId::shadow_map] = light_buffers.answer(job);
    lit.resize(plan.lights.size() * pixels);
    const Stopwatch tracing;
    frame.stats = trace_frame(job, caster, pool, TracedFrame<double>{picture, ids, lit});
    frame.timings[PassId::trace] = tracing.elapsed_ms();

    const Stopwatch unpacking;
    frame.picture = picture_from_rgba(picture.data(), part.width_px, part.height_px, kept, settings.alpha, frame.stats);
    frame.timings[PassId::download] = unpacking.elapsed_ms();
    frame.aovs = make_aovs(scene, plan.view, kept, {plan.lights, ids, {}, lit, {}}, settings.aovs);
    return frame;
  });
}

}  // namespace hybridrt
