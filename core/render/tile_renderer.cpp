#include "core/render/tile_renderer.h"

#include <algorithm>
#include <optional>

#include "core/base/check.h"
#include "core/base/timing.h"
#include "core/render/aov.h"
#include "core/render/frame_edges.h"
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
  EdgeMemory edges;

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

int parts_across(const View& view) { return (view.width_px + TileWorker::kPart_px - 1) / TileWorker::kPart_px; }

size_t part_count(const View& view) {
  return static_cast<size_t>(parts_across(view)) * ((view.height_px + TileWorker::kPart_px - 1) / TileWorker::kPart_px);
}

Tile part_of_picture(const View& view, size_t part) {
  const int x = static_cast<int>(part) % parts_across(view) * TileWorker::kPart_px;
  const int y = static_cast<int>(part) / parts_across(view) * TileWorker::kPart_px;
  return {x, y, std::min(x + TileWorker::kPart_px, view.width_px), std::min(y + TileWorker::kPart_px, view.height_px)};
}

class TileRenderer {
 public:
  TileRenderer(const Scene& scene, const SceneFacts& facts, const Sheets& sheets, const RenderSettings& settings,
               const RayCaster<float>* caster, ThreadPool& pool)
      : scene_(scene),
        facts_(facts),
        settings_(settings),
        caster_(caster),
        pool_(pool),
        by_rays_(settings.method == Method::raytrace),
        light_buffers_(scene, sheets, pool) {
    if (!by_rays_) clusters_ = make_clusters(scene, pool);
    if (!by_rays_) memory_.raster.tiles.resize(pool.size());
  }

  Frame render(const FrameRequest& request) {
    const FramePlan plan = make_frame_plan(scene_, facts_, request, settings_);
    TraceJob trace = make_trace_job(scene_, plan, settings_);
    Frame frame;
    frame.number = plan.number;
    if (plan.light_buffers) frame.timings[PassId::shadow_map] = light_buffers_.answer(trace);
    if (!by_rays_) {
      const Stopwatch binning;
      bin_clusters(scene_, clusters_, plan.view, pool_, memory_.raster.bins);
      frame.timings[PassId::id] = binning.elapsed_ms();
    }
    frame.picture = Image::uninitialized(plan.view.width_px, plan.view.height_px, settings_.alpha ? 4 : 3);
    draw(plan, trace, frame);
    if (takes_edge_samples(settings_))
      sample_frame_edges(plan, trace, settings_,
                         {*caster_, by_rays_ ? nullptr : &clusters_, memory_.raster, memory_.edges}, pool_, frame);
    frame.aovs = make_aovs(scene_, plan.view, kept_of_rendered(settings_),
                           {plan.lights, memory_.ids, memory_.mask, memory_.lit, memory_.traced}, settings_.aovs);
    return frame;
  }

 private:
  /// Passes 2 to 5: tiles of the rasteriser, or parts of the picture whose triangles rays find.
  void draw(const FramePlan& plan, const TraceJob& trace, Frame& frame) {
    const Stopwatch drawing;
    const FrameBins& bins = memory_.raster.bins;
    const TileJob job{plan, trace, clusters_, bins, caster_, memory_.pixels_for(plan, settings_.aovs, frame.picture)};
    std::vector<std::optional<TileWorker>> workers(pool_.size());
    pool_.run(by_rays_ ? part_count(plan.view) : bins.order.size(), [&](size_t i, int worker) {
      if (!workers[worker]) workers[worker].emplace(job, by_rays_ ? nullptr : &memory_.raster.tiles[worker]);
      if (by_rays_)
        workers[worker]->render_by_rays(part_of_picture(plan.view, i));
      else
        workers[worker]->render(static_cast<int>(bins.order[i]));
    });
    PassTimes threads_ms{};
    for (const std::optional<TileWorker>& worker : workers) {
      if (!worker) continue;
      frame.stats.add(worker->stats());
      for (size_t pass = 0; pass < threads_ms.size(); ++pass) threads_ms[pass] += worker->times_ms()[pass];
    }
    add_threads_times(frame.timings, threads_ms, drawing.elapsed_ms());
  }

  const Scene& scene_;
  const SceneFacts& facts_;
  const RenderSettings& settings_;
  const RayCaster<float>* caster_;
  ThreadPool& pool_;
  const bool by_rays_;  ///< method raytrace
  Clusters clusters_;   ///< empty then
  KeptLightBuffers light_buffers_;
  FrameMemory memory_;
};

}  // namespace

void render_tiles(const Scene& scene, const SceneFacts& facts, const Sheets& sheets, const RenderSettings& settings,
                  const RayCaster<float>* caster, ThreadPool& pool, const NextFrame& next,
                  const DeliverFrame& deliver) {
  HRT_CHECK(!uses_shadow_map(settings));
  const PixelRect part = rendered_rect(settings), kept = kept_of_rendered(settings);
  HRT_CHECK(part.width_px == kept.width_px && part.height_px == kept.height_px);
  TileRenderer renderer(scene, facts, sheets, settings, caster, pool);
  render_each(next, deliver, [&](const FrameRequest& request) { return renderer.render(request); });
}

}  // namespace hybridrt
