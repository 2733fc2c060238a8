#include "core/render/reference_renderer.h"

#include <mutex>

#include "core/base/timing.h"
#include "core/passes_cpu/trace_pass.h"
#include "core/render/aov.h"
#include "core/render/edge_samples.h"
#include "core/render/kept_light_buffers.h"
#include "core/render/samples.h"
#include "core/trace/ray_generations.h"

namespace hybridrt {
namespace {

/// Takes the samples near edges of a frame (sample_edges), in double precision.
void take_edge_samples(const FramePlan& plan, const TraceJob& job, const RenderSettings& settings,
                       const RayCaster<double>& caster, ThreadPool& pool, EdgeMemory& memory, Frame& frame) {
  const EdgeSampling sampling{settings.samples, /*retake_first=*/job.scene.textures != nullptr};
  TraceStats stats;
  std::mutex mutex;
  const auto take = [&](std::span<const PixelAt> pixels, const GiveColors& give) {
    parallel_for(pool, pixels.size(), std::min<size_t>(1024, sampling.pixels_at_once()), [&](size_t begin, size_t end) {
      const size_t count = end - begin;
      std::vector<vec4> colors;
      std::vector<dvec3> light(count);
      std::vector<RayGenerations<double>::PrimaryHit> seen(count);
      TraceStats of_these;
      for (int sample = sampling.first_taken(); sample < sampling.samples; ++sample) {
        View view = plan.view;
        view.sample_px = sample_offset_px(sample);
        view.samples = sampling.samples;
        const TraceJob at{job.scene,   view,           job.lights,      job.shadows, job.reflection_depth,
                          job.ambient, job.background, job.eye_enclosed};
        RayGenerations<double> generations(at, &caster);
        for (size_t i = 0; i < count; ++i)
          generations.add_primary(static_cast<uint32_t>(i), pixels[begin + i].x, pixels[begin + i].y);
        light.assign(count, dvec3(0)), seen.assign(count, {});
        generations.run(light, seen, of_these);
        for (size_t i = 0; i < count; ++i) {
          const bool found = seen[i].triangle != kNoTriangle;
          colors.push_back(found || !settings.alpha ? vec4(vec3(light[i]), found) : vec4(0));
        }
      }
      give(begin, count, colors);
      const std::lock_guard lock(mutex);
      stats.add(of_these);
    });
  };
  const Stopwatch tracing;
  frame.stats.pixels_resampled = sample_edges(frame.picture, sampling, pool, memory, take);
  frame.timings[PassId::trace] += tracing.elapsed_ms();
  frame.stats.add(stats);
}

}  // namespace

void render_reference(const Scene& scene, const SceneFacts& facts, const Sheets& sheets, const RenderSettings& settings,
                      const RayCaster<double>& caster, ThreadPool& pool, const NextFrame& next,
                      const DeliverFrame& deliver) {
  const PixelRect part = rendered_rect(settings), kept = kept_of_rendered(settings);
  const size_t pixels = static_cast<size_t>(part.width_px) * part.height_px;
  std::vector<vec4> picture(pixels);
  std::vector<uint32_t> ids(pixels);
  std::vector<uint8_t> lit;
  EdgeMemory edges;

  KeptLightBuffers light_buffers(scene, sheets, pool);
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
    if (takes_edge_samples(settings)) take_edge_samples(plan, job, settings, caster, pool, edges, frame);
    frame.aovs = make_aovs(scene, plan.view, kept, {plan.lights, ids, {}, lit, {}}, settings.aovs);
    return frame;
  });
}

}  // namespace hybridrt
