#include "core/render/kept_shadow_maps.h"

#include "core/base/timing.h"
#include "core/passes/receiver_hull.h"
#include "core/passes_cpu/receiver_depths.h"

namespace hybridrt {

bool KeptShadowMaps::is_kept(const FramePlan& plan, size_t light) const {
  if (!plan.casts_shadow(light)) return true;
  const Map& map = maps_[light];
  return map.light && map.light->toward == plan.lights[light].toward &&
         (settings_.shadow_warp == ShadowWarp::uniform || map.view == at_centres(plan.view));
}

/// A warped map is fitted to all that the whole frame sees, so that a part of a frame has the same pixels as the whole.
std::vector<dvec3> KeptShadowMaps::visible_receivers(const FramePlan& plan, std::span<const uint32_t> ids) {
  const View whole = whole_frame_of(plan.view);
  if (renders_part(settings_)) {
    whole_ids_.resize(static_cast<size_t>(whole.width_px) * whole.height_px);
    rasterize_ids(scene_, clusters_, whole, pool_, whole_raster_, whole_ids_);
    ids = whole_ids_;
  }
  std::vector<vec2> blocks(static_cast<size_t>(receiver_blocks(whole.width_px)) * receiver_blocks(whole.height_px));
  receiver_depths(scene_, whole, plan.near_distance, ids, pool_, blocks);
  return receiver_hull(whole, plan.near_distance, blocks);
}

double KeptShadowMaps::update(const FramePlan& plan, std::span<const uint32_t> ids) {
  const Stopwatch drawing;
  const bool warped = settings_.shadow_warp == ShadowWarp::lispsm;
  const int size_px = settings_.shadow_map_px;
  std::optional<std::vector<dvec3>> seen;
  bool drawn = false;
  maps_.resize(plan.lights.size());
  for (size_t l = 0; l < maps_.size(); ++l) {
    if (is_kept(plan, l)) continue;
    Map& map = maps_[l];
    const dvec3& toward = plan.lights[l].toward;
    if (!map.light || map.light->toward != toward) map.light = fit_light_frame(scene_, toward);
    map.view = at_centres(plan.view);
    if (warped && !seen) seen = visible_receivers(plan, ids);
    map.fit = warped ? fit_shadow_map(*map.light, plan.view, *seen, size_px) : uniform_shadow_map(*map.light, size_px);
    map.depth.resize(static_cast<size_t>(size_px) * size_px);
    draw_shadow_map(scene_, map.fit, size_px, pool_, memory_, map.depth);
    drawn = true;
  }
  return drawn ? drawing.elapsed_ms() : 0;
}

}  // namespace hybridrt
