#include "core/passes_cpu/trace_pass.h"

#include <bit>
#include <mutex>

#include "core/base/timing.h"
#include "core/trace/primary_surface.h"
#include "core/trace/ray_generations.h"
#include "core/trace/tile.h"
#include "shaders/shared.h"

namespace hybridrt {
namespace {

constexpr int kTile_px = 32;

/// Calls body(tile, stats) for every tile of the picture; returns the sum of the stats. Counts do not depend on the
/// order of the tiles.
template <typename Body>
TraceStats for_each_tile(const View& view, ThreadPool& pool, const Body& body) {
  const int tiles_x = (view.width_px + kTile_px - 1) / kTile_px;
  const int tiles_y = (view.height_px + kTile_px - 1) / kTile_px;
  TraceStats total;
  std::mutex mutex;
  pool.run(static_cast<size_t>(tiles_x) * tiles_y, [&](size_t index, int) {
    const int x0 = static_cast<int>(index) % tiles_x * kTile_px, y0 = static_cast<int>(index) / tiles_x * kTile_px;
    TraceStats stats;
    body(Tile{x0, y0, std::min(x0 + kTile_px, view.width_px), std::min(y0 + kTile_px, view.height_px)}, stats);
    std::lock_guard lock(mutex);
    total.add(stats);
  });
  return total;
}

/// The surface that a pixel sees, recomputed from its triangle in double precision.
Surface<float> surface_from(const TraceJob& job, uint32_t triangle, const dvec3& weights, const dvec3& dir) {
  return surface_at(job.scene, triangle, static_cast<float>(weights.y), static_cast<float>(weights.z), vec3(dir));
}

/// One tile of pass 4 and its scratch memory.
class TileTrace {
 public:
  TileTrace(const TraceJob& job, const RayCaster<float>* caster, const TracePixels& pixels)
      : job_(job),
        caster_(caster),
        pixels_(pixels),
        generations_(job, caster),
        asks_buffers_(job.has_buffers()),
        shadow_queues_(job.lights.size()) {}

  void run(const Tile& tile, TraceStats& stats) {
    std::vector<vec3> colors(pixels_.traced.empty() ? 0 : tile.pixel_count());
    const double started_ms = thread_cpu_ms();
    tile.for_each_pixel_in_blocks([&](int x, int y, uint32_t in_tile) { visit(x, y, in_tile, stats); });
    ask_shadow_rays(stats);
    stats.shadow_cpu_ms += thread_cpu_ms() - started_ms;

    if (pixels_.traced.empty()) return;
    generations_.run(colors, {}, stats);
    for (int y = tile.y0; y < tile.y1; ++y)
      for (int x = tile.x0; x < tile.x1; ++x) {
        const size_t in_tile = static_cast<size_t>(y - tile.y0) * tile.width() + static_cast<size_t>(x - tile.x0);
        pixels_.traced[index_of(x, y)] = vec4(colors[in_tile], 0);
      }
  }

 private:
  size_t index_of(int x, int y) const { return static_cast<size_t>(y) * job_.view.width_px + x; }

  void visit(int x, int y, uint32_t in_tile, TraceStats& stats) {
    const size_t index = index_of(x, y);
    const uint32_t triangle = pixels_.ids[index];
    const unsigned asked = pixels_.lit.empty() ? 0 : take_over_answers(index, triangle);
    if (triangle == kNoTriangle) return;
    ++stats.pixels_hit;
    stats.pixels_marked += std::popcount(asked);

    const Material& material = job_.scene.material_of(triangle);
    const bool scatters = !pixels_.traced.empty() && (material.reflective() || material.transmissive());
    if (asked == 0 && !scatters) return;

    const dvec3 dir = glm::normalize(job_.view.pixel_dir(x, y));
    if (asked != 0) ask_lights(asked, index, triangle, dir);
    if (scatters) scatter(x, y, in_tile, triangle, dir, stats);
  }

  /// Copies the answers that pass 3 already has. Returns the lights (bits) that the pixel must ask.
  unsigned take_over_answers(size_t index, uint32_t triangle) const {
    unsigned asked = 0;
    for (size_t l = 0; l < job_.lights.size(); ++l) {
      const size_t at = l * pixels_.ids.size() + index;
      pixels_.lit[at] = 0;
      if (triangle == kNoTriangle || !job_.casts_shadow(l)) continue;
      if (pixels_.mask.empty() || (pixels_.mask[at] & HRT_MASK_MARKED))
        asked |= 1u << l;
      else
        pixels_.lit[at] = pixels_.mask[at] & HRT_MASK_LIT;
    }
    return asked;
  }

  void scatter(int x, int y, uint32_t in_tile, uint32_t triangle, const dvec3& dir, TraceStats& stats) {
    const dvec3 weights = seen_barycentrics(job_.scene, triangle, job_.view.eye, dir);
    float distance = 0, solid_angle = 0;
    if (job_.scene.textures) {
      distance =
          static_cast<float>(glm::distance(job_.view.eye, dvec3(surface_from(job_, triangle, weights, dir).point)));
      solid_angle = static_cast<float>(job_.view.sample_solid_angle(x, y));
    }
    generations_.add_seen(in_tile, triangle, static_cast<float>(weights.y), static_cast<float>(weights.z), vec3(dir),
                          distance, solid_angle, stats);
  }

  void ask_lights(unsigned asked, size_t index, uint32_t triangle, const dvec3& dir) {
    if (asks_buffers_)
      for_each_facing_light(job_.scene, triangle, job_.view.eye, dir, job_.lights,
                            [&](size_t l, const ShadowQuery& query) {
                              if (!(asked >> l & 1)) return;
                              shadow_queues_[l].queries.push_back(query);
                              shadow_queues_[l].queries.back().anywhere = job_.eye_enclosed;
                              shadow_queues_[l].owners.push_back(index);
                            });
    else
      ask_lights_by_rays(asked, index, triangle, dir);
  }

  void ask_lights_by_rays(unsigned asked, size_t index, uint32_t triangle, const dvec3& dir) {
    const Surface<float> surface =
        surface_from(job_, triangle, seen_barycentrics(job_.scene, triangle, job_.view.eye, dir), dir);
    for (size_t l = 0; l < shadow_queues_.size(); ++l) {
      const vec3 to_light(job_.lights[l].light.toward);
      if (!(asked >> l & 1) || glm::dot(surface.side, to_light) <= 0) continue;  // the unlit side needs no ray
      shadow_queues_[l].rays.push_back(leave(surface, to_light));
      shadow_queues_[l].owners.push_back(index);
    }
  }

  void ask_shadow_rays(TraceStats& stats) {
    for (size_t l = 0; l < shadow_queues_.size(); ++l) {
      ShadowQueue<float>& queue = shadow_queues_[l];
      queue.answer(job_.lights[l], caster_);
      const std::span<uint8_t> lit = pixels_.lit.subspan(l * pixels_.lit.size() / shadow_queues_.size());
      for (size_t i = 0; i < queue.owners.size(); ++i) lit[queue.owners[i]] = queue.occluded[i] ? 0 : HRT_MASK_LIT;
      stats.shadow_rays += static_cast<int64_t>(queue.owners.size());
      stats.primary_shadow_rays += static_cast<int64_t>(queue.owners.size());
    }
  }

  const TraceJob& job_;
  const RayCaster<float>* caster_;
  const TracePixels& pixels_;
  RayGenerations<float> generations_;
  const bool asks_buffers_;
  std::vector<ShadowQueue<float>> shadow_queues_;  ///< one per light; owners are pixels
};

}  // namespace

TraceStats trace_pass(const TraceJob& job, const RayCaster<float>* caster, ThreadPool& pool,
                      const TracePixels& pixels) {
  return for_each_tile(job.view, pool,
                       [&](const Tile& tile, TraceStats& stats) { TileTrace(job, caster, pixels).run(tile, stats); });
}

template <typename Real>
TraceStats trace_frame(const TraceJob& job, const RayCaster<Real>& caster, ThreadPool& pool,
                       const TracedFrame<Real>& frame) {
  return for_each_tile(job.view, pool, [&](const Tile& tile, TraceStats& stats) {
    RayGenerations<Real> generations(job, &caster);
    std::vector<Vec3<Real>> colors(tile.pixel_count());
    std::vector<typename RayGenerations<Real>::PrimaryHit> primary(tile.pixel_count());
    tile.for_each_pixel_in_blocks([&](int x, int y, uint32_t in_tile) { generations.add_primary(in_tile, x, y); });
    generations.run(colors, primary, stats);

    uint32_t in_tile = 0;
    for (int y = tile.y0; y < tile.y1; ++y)
      for (int x = tile.x0; x < tile.x1; ++x, ++in_tile) {
        const size_t index = static_cast<size_t>(y) * job.view.width_px + x;
        const float alpha = primary[in_tile].triangle == kNoTriangle ? HRT_ALPHA_BACKGROUND
                            : primary[in_tile].lit == 0              ? HRT_ALPHA_UNLIT
                                                                     : HRT_ALPHA_LIT;
        frame.picture[index] = vec4(vec3(colors[in_tile]), alpha);
        frame.ids[index] = primary[in_tile].triangle;
        for (size_t l = 0; l < job.lights.size(); ++l)
          frame.lit[l * frame.ids.size() + index] = primary[in_tile].lit >> l & 1 ? HRT_MASK_LIT : 0;
      }
  });
}

template TraceStats trace_frame(const TraceJob&, const RayCaster<float>&, ThreadPool&, const TracedFrame<float>&);
template TraceStats trace_frame(const TraceJob&, const RayCaster<double>&, ThreadPool&, const TracedFrame<double>&);

}  // namespace hybridrt
