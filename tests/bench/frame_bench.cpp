// Whole frames: the hybrid on the CPU, our own ray tracer and a plain Embree program, on the same scene, view and
// light.
//   frame_bench [--threads=N] [--rounds=N] [--size=1024x768] [--depth=N] [--target=NAME] [--alone] SCENE...
// The three take turns, and medians of the rounds are printed in milliseconds, with what Embree's and the ray tracer's
// frames take over the hybrid's, and the hybrid's passes by the threads' time. --alone: the hybrid only, for a
// profiler.

#include <algorithm>

#include "core/base/timing.h"
#include "core/render/scene_caster.h"
#include "core/render/tile_renderer.h"
#include "tests/bench/bench_options.h"
#include "tests/bench/embree_frame.h"
#include "tests/bench/ray_sets.h"

namespace hybridrt {
namespace {

double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return values.empty() ? 0 : values[values.size() / 2];
}

/// The camera that has the bench's view.
Camera camera_of(const View& view) {
  return {view.eye, view.eye + view.forward, view.up, 2 * std::atan(view.tan_half_height)};
}

void measure(const std::string& name, const BenchOptions& options, ThreadPool& pool) {
  BenchScene bench = load_bench_scene(name, pool);
  bench.scene.origin_world = dvec3(0);
  const SceneFacts facts = make_scene_facts(bench.scene);
  const Sheets sheets = make_sheets(bench.scene, build_topology(bench.scene, pool), pool);
  RenderSettings settings;
  settings.forms = PassForms::cpu;
  settings.width_px = options.width_px, settings.height_px = options.height_px;
  settings.reflection_depth = options.depth;
  const FrameRequest request{1, camera_of(bench.view), {{bench.toward}}};
  const SceneCaster<float> caster = make_scene_caster(bench.scene, Accel::embree, pool);
  const EmbreeFrame embree(bench.scene, options.threads);

  // What the plain Embree program needs.
  const FramePlan plan = make_frame_plan(bench.scene, facts, request, settings);
  const TraceJob plain = make_trace_job(bench.scene, plan, settings);
  std::vector<vec4> picture(static_cast<size_t>(options.width_px) * options.height_px);
  RenderSettings by_rays = settings;
  by_rays.method = Method::raytrace, by_rays.shadows = ShadowMode::rays;

  /// The second of two frames: the first pays for the light buffer.
  const auto second_frame = [&](const RenderSettings& chosen) {
    std::pair<double, Frame> timed;
    Stopwatch watch;
    int asked = 0;
    const auto next = [&]() -> std::optional<FrameRequest> {
      if (asked++ == 2) return std::nullopt;
      watch.restart();
      return request;
    };
    const auto deliver = [&](Frame&& frame) { timed = {watch.elapsed_ms(), std::move(frame)}; };
    render_tiles(bench.scene, facts, sheets, chosen, caster.caster.get(), pool, next, deliver);
    return timed;
  };

  std::vector<double> hybrid_ms, raytrace_ms, embree_ms;
  std::vector<std::vector<double>> passes(static_cast<size_t>(PassId::count));
  for (int round = -1; round < options.rounds; ++round) {
    const auto [ms, frame] = second_frame(settings);
    const double raytrace = options.alone ? 0 : second_frame(by_rays).first;
    const Stopwatch watch;
    if (!options.alone) embree.render(plain, pool, picture);
    const double all_embree = watch.elapsed_ms();
    if (round < 0) continue;  // warm now
    hybrid_ms.push_back(ms), raytrace_ms.push_back(raytrace), embree_ms.push_back(all_embree);
    for (size_t i = 0; i < passes.size(); ++i)
      passes[i].push_back(frame.timings.threads_ms[i] > 0 ? frame.timings.threads_ms[i] : frame.timings.pass_ms[i]);
  }
  const double hybrid = median(hybrid_ms);
  printf("\"%s\",%zu,%.2f,%.2f,%.2f,%.2f,%.2f", name.c_str(), bench.scene.triangle_count(), hybrid, median(raytrace_ms),
         median(embree_ms), median(embree_ms) / hybrid, median(raytrace_ms) / hybrid);
  for (const PassId pass : {PassId::id, PassId::mark, PassId::trace, PassId::shade, PassId::download})
    printf(",%.2f", median(passes[static_cast<size_t>(pass)]));
  printf("\n");
  fflush(stdout);
}

}  // namespace
}  // namespace hybridrt

int main(int argc, char** argv) {
  return hybridrt::print_table(
      argc, argv, "scene,triangles,hybrid,raytrace,embree,embree/hybrid,raytrace/hybrid,id,mark,trace,shade,download",
      hybridrt::measure);
}
