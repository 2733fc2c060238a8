#include "core/render/tile_renderer.h"

#include <algorithm>
#include <numeric>
#include <optional>

#include "core/base/check.h"
#include "core/base/timing.h"
#include "core/render/aov.h"
#include "core/render/kept_light_buffers.h"
#include "core/render/tile_frame.h"
#include "shaders/shared.h"

namespace hybridrt {
namespace {

/// Memory that is kept from frame to frame.
struct FrameMemory {
  std::vector<vec4> traced;
  std::vector<uint32_t> ids;
  std::vector<uint8_t> mask, lit;
  RasterMemory raster;

  /// Arrays for a frame of so many pixels; those that only AOVs show are empty where no AOV asks for them.
  TilePixels pixels_for(const FramePlan& plan, uint32_t aovs, Image& picture) {
    const size_t pixel_count = picture.pixel_count();
    const size_t lights = plan.lights.size();
    ids.resize(plan.read_ids && (aovs & (kAovId | kAovDepth | kAovNormal)) ? pixel_count : 0);
    lit.assign(plan.trace_shadows && (aovs & kAovShadow) ? lights * pixel_count : 0, 0);
    mask.assign(plan.mark_exact && (aovs & kAovMarked) ? lights * pixel_count : 0, 0);
    traced.assign(plan.trace_scattered && (aovs & kAovTraced) ? pixel_count : 0, vec4(0));
    return {picture, ids, mask, lit, traced};
  }
};

/// The threads' time of each pass, and that time shared out over the wall time that they took together.
void set_timings(FrameTimings& timings, const PassTimes& threads_ms, double wall_ms) {
  const double sum = std::accumulate(threads_ms.begin(), threads_ms.end(), 0.0);
  timings.threads_ms = threads_ms;
  if (sum <= 0) return;
  for (size_t pass = 0; pass < threads_ms.size(); ++pass) timings.pass_ms[pass] += threads_ms[pass] / sum * wall_ms;
}

int parts_across(const View& view) { return (view.width_px + TileWorker::kPart_px - 1) / TileWorker::kPart_px; }

size_t part_count(const View& view) {
  return static_cast<size_t>(parts_across(view)) * ((view.height_px + TileWorker::kPart_px - 1) / TileWorker::kPart_px);
}

Tile part_of_picture(const View& view, size_t part) {
  const int x = static_cast<int>(part) % parts_across(view) * TileWorker::kPart_px;
  const int y = static_cast<int>(part) / parts_across(view) * TileWorker::kPart_px;
  return {x, y, std::min(x + TileWorker::kPart_px, view.width_px), std::min(y + TileWorker::kPart_px, view.height_px)};
}

}  // namespace

void render_tiles(const Scene& scene, const SceneFacts& facts, const Topology& topology, const RenderSettings& settings,
                  const RayCaster<float>* caster, ThreadPool& pool, const NextFrame& next,
                  const DeliverFrame& deliver) {
  HRT_CHECK(!uses_shadow_map(settings));
  const PixelRect part = rendered_rect(settings), kept = kept_of_rendered(settings);
  HRT_CHECK(part.width_px == kept.width_px && part.height_px == kept.height_px);
  const bool by_rays = settings.method == Method::raytrace;
  const Clusters clusters = by_rays ? Clusters() : make_clusters(scene, pool);
  KeptLightBuffers light_buffers(scene, topology, pool);
  FrameMemory memory;
  memory.raster.tiles.resize(pool.size());
  Stopwatch since_last_frame;
  while (const std::optional<FrameRequest> request = next()) {
    const FramePlan plan = make_frame_plan(scene, facts, *request, settings);
    TraceJob trace = make_trace_job(scene, plan, settings);
    Frame frame;
    frame.number = plan.number;
    if (plan.light_buffers) frame.timings[PassId::shadow_map] = light_buffers.answer(trace);

    const Stopwatch binning;
    if (!by_rays) bin_clusters(scene, clusters, plan.view, pool, memory.raster.bins);
    frame.timings[PassId::id] = by_rays ? 0 : binning.elapsed_ms();

    const Stopwatch drawing;
    frame.picture = Image::uninitialized(part.width_px, part.height_px, settings.alpha ? 4 : 3);
    const TileJob job{plan,
                      trace,
                      by_rays ? nullptr : &clusters,
                      memory.raster.bins,
                      caster,
                      memory.pixels_for(plan, settings.aovs, frame.picture)};
    std::vector<std::optional<TileWorker>> workers(pool.size());
    pool.run(by_rays ? part_count(plan.view) : memory.raster.bins.order.size(), [&](size_t i, int worker) {
      if (!workers[worker]) workers[worker].emplace(job, memory.raster.tiles[worker]);
      if (by_rays)
        workers[worker]->render_by_rays(part_of_picture(plan.view, i));
      else
        workers[worker]->render(static_cast<int>(memory.raster.bins.order[i]));
    });
    PassTimes threads_ms{};
    for (const std::optional<TileWorker>& worker : workers) {
      if (!worker) continue;
      frame.stats.add(worker->stats());
      for (size_t pass = 0; pass < threads_ms.size(); ++pass) threads_ms[pass] += worker->times_ms()[pass];
    }
    set_timings(frame.timings, threads_ms, drawing.elapsed_ms());

    frame.aovs = make_aovs(scene, plan.view, kept, {plan.lights, memory.ids, memory.mask, memory.lit, memory.traced},
                           settings.aovs);
    frame.timings.wall_ms = since_last_frame.elapsed_ms();
    since_last_frame.restart();
    deliver(std::move(frame));
  }
}

}  // namespace hybridrt
