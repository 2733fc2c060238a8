#include "core/render/render_job.h"

#include "core/render/cpu_renderer.h"
#include "core/render/gl_renderer.h"
#include "core/trace/embree_caster.h"
#include "core/trace/kd_caster.h"
#include "core/trace/kd_tree.h"

namespace hybridrt {
namespace {

/// A caster and the tree that it looks into, which must not move.
template <typename Real>
struct OwnedCaster {
  std::unique_ptr<KdTree> tree;
  std::unique_ptr<RayCaster<Real>> caster;
};

OwnedCaster<float> make_caster(const RenderJob& job, ThreadPool& pool, RunFacts& facts) {
  const Stopwatch building;
  OwnedCaster<float> owned;
  if (job.accel == Accel::embree) {
    owned.caster = make_embree_caster(job.scene, job.threads);
  } else {
    owned.tree = std::make_unique<KdTree>(build_kd_tree(job.scene, pool));
    owned.caster = make_kd_caster(*owned.tree, LeafKernel::simd);
  }
  facts.accel = name_of(job.accel);
  facts.accel_build_ms = building.elapsed_ms();
  return owned;
}

OwnedCaster<double> make_reference(const RenderJob& job, ThreadPool& pool, RunFacts& facts) {
  const Stopwatch building;
  OwnedCaster<double> owned;
  owned.tree = std::make_unique<KdTree>(build_kd_tree(job.scene, pool));
  owned.caster = make_reference_caster(*owned.tree);
  facts.accel = "kdtree (double)";
  facts.accel_build_ms = building.elapsed_ms();
  return owned;
}

}  // namespace

FrameRequest frame_request(const RenderJob& job, int frame) {
  return {frame, camera_at(job.motion, frame), light_at(job.light, job.motion, frame)};
}

RunFacts run(const RenderJob& job, const std::function<void(const RunFacts&)>& starting,
             const std::function<bool()>& stop, const DeliverFrame& deliver) {
  const Stopwatch preparing;
  RunFacts facts;
  ThreadPool pool(job.threads);
  FrameCursor cursor(job.frames);
  const NextFrame next = [&]() -> std::optional<FrameRequest> {
    if (stop()) return std::nullopt;
    const std::optional<int> number = cursor.next();
    if (!number) return std::nullopt;
    return frame_request(job, *number);
  };
  const auto ready = [&] {
    facts.ready_ms = preparing.elapsed_ms();
    starting(facts);
  };

  if (job.settings.method == Method::reference) {
    const OwnedCaster<double> owned = make_reference(job, pool, facts);
    ready();
    render_on_cpu(job.scene, job.settings, *owned.caster, pool, next, deliver);
  } else if (job.settings.method == Method::raytrace) {
    const OwnedCaster<float> owned = make_caster(job, pool, facts);
    ready();
    render_on_cpu(job.scene, job.settings, *owned.caster, pool, next, deliver);
  } else {
    gl::ContextRequest request = job.gl;
    request.threads = job.threads;
    const std::unique_ptr<gl::Context> context = gl::open_context(request);
    facts.gl = context->info();
    OwnedCaster<float> owned;
    if (may_trace(make_scene_facts(job.scene), job.settings)) owned = make_caster(job, pool, facts);
    GlRenderer renderer(*context, job.shaders, job.scene, job.settings, owned.caster.get(), pool);
    ready();
    renderer.render(next, deliver);
  }
  return facts;
}

}  // namespace hybridrt
