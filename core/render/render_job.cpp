#include "core/render/render_job.h"

#include "core/base/start_thread.h"
#include "core/base/timing.h"
#include "core/mesh/inside_out.h"
#include "core/mesh/reflective_share.h"
#include "core/render/gl_renderer.h"
#include "core/render/mapped_renderer.h"
#include "core/render/reference_renderer.h"
#include "core/render/samples.h"
#include "core/render/still_frames.h"
#include "core/render/tile_renderer.h"

namespace hybridrt {

void set_scene(RenderJob& job, Scene scene, ThreadPool& pool, Warnings& warnings,
               std::optional<double> reflection_percent) {
  job.scene = std::move(scene);
  job.topology = build_topology(job.scene, pool);
  turn_inside_out_bodies(job.scene, job.topology, pool, warnings);
  if (reflection_percent) set_reflective_share(job.scene, job.topology, *reflection_percent);
  job.sheets = make_sheets(job.scene, job.topology, pool);
  drop_edges(job.topology);
  job.facts = make_scene_facts(job.scene);
}

FrameRequest frame_request(const RenderJob& job, int frame) {
  return {frame, camera_at(job.motion, frame), lights_at(job.lights, job.motion, frame),
          lights_move(job.lights, job.motion)};
}

RunFacts run(const RenderJob& job, ThreadPool& pool, const std::function<void(const RunFacts&)>& starting,
             const std::function<bool()>& stop, const DeliverFrame& deliver_frame) {
  const Stopwatch preparing;
  RunFacts facts;
  FrameCursor cursor(job.frames);
  const auto next_frame = [&]() -> std::optional<FrameRequest> {
    while (!stop()) {
      const std::optional<int> number = cursor.next();
      if (!number) break;
      if (!job.wants || job.wants(*number)) return frame_request(job, *number);
    }
    return std::nullopt;
  };
  const FrameEnds ends =
      job.repeats_still_frames ? without_repeats(next_frame, deliver_frame) : FrameEnds{next_frame, deliver_frame};
  const int frame_samples = takes_edge_samples(job.settings) ? 1 : job.settings.samples;  // of every pixel
  const NextFrame next = sampled(ends.next, frame_samples);
  const DeliverFrame deliver = averaged(ends.deliver, frame_samples);
  const auto ready = [&] {
    facts.ready_ms = preparing.elapsed_ms();
    starting(facts);
  };

  const auto remember = [&](const auto& scene_caster, std::string_view accel) {
    facts.accel = accel;
    facts.accel_build_ms = scene_caster.build_ms;
  };
  // The default camera may have built one already.
  SceneCaster<float> built;
  const auto caster = [&]() -> const RayCaster<float>& {
    if (!job.caster.caster) built = make_scene_caster(job.scene, job.settings.accel, pool);
    const SceneCaster<float>& used = job.caster.caster ? job.caster : built;
    remember(used, name_of(job.settings.accel));
    return *used.caster;
  };

  if (job.settings.method == Method::reference) {
    const SceneCaster<double> reference = make_reference_scene_caster(job.scene, pool);
    remember(reference, "kdtree (double)");
    ready();
    render_reference(job.scene, job.facts, job.sheets, job.settings, *reference.caster, pool, next, deliver);
  } else if (job.settings.method == Method::raytrace) {
    const RayCaster<float>& rays = caster();
    ready();
    render_tiles(job.scene, job.facts, job.sheets, job.settings, &rays, pool, next, deliver);
  } else if (job.settings.forms == PassForms::cpu) {
    const bool rays_needed = needs_caster(job.facts, job.settings, lights_move(job.lights, job.motion));
    const RayCaster<float>* const rays = rays_needed ? &caster() : nullptr;
    ready();
    const auto& render = uses_shadow_map(job.settings) ? render_mapped : render_tiles;
    render(job.scene, job.facts, job.sheets, job.settings, rays, pool, next, deliver);
  } else {
    require_threads(pool.size() + 1);  // a software GL waits forever for those of its own that do not start
    const std::unique_ptr<gl::Context> context = gl::open_context(job.gl);
    facts.gl = context->info();
    const bool rays_needed = needs_caster(job.facts, job.settings, lights_move(job.lights, job.motion));
    GlRenderer renderer(*context, job.shaders, job.scene, job.facts, job.sheets, job.settings, job.lights.lights.size(),
                        rays_needed ? &caster() : nullptr, pool);
    ready();
    renderer.render(next, deliver);
  }
  return facts;
}

}  // namespace hybridrt
