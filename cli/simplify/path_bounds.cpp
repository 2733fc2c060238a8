#include "cli/simplify/path_bounds.h"

#include <limits>

#include "cli/interrupt.h"

namespace hybridrt::cli {
namespace {

constexpr size_t kFramesAtOnce = 64;

}  // namespace

Sight sight_of(const RenderJob& job, int frame) {
  const FrameRequest request = frame_request(job, frame);
  Sight sight{make_view(request.camera, job.scene.origin_world, job.settings.width_px, job.settings.height_px), {}};
  if (job.settings.shadows == ShadowMode::none) return sight;
  for (const DirectionalLight& light : request.lights)
    if (light.casts_shadow) sight.toward_lights.push_back(light.toward);
  return sight;
}

std::vector<float> bounds_on_path(const RenderJob& job, double max_error_px, ThreadPool& pool) {
  std::vector<float> bounds(job.scene.triangle_count(), std::numeric_limits<float>::max());
  keep_mirrors(job.scene, bounds);
  FrameCursor cursor(job.frames);
  std::vector<Sight> sights;
  const auto narrow = [&] {
    narrow_bounds(job.scene, sights, max_error_px, bounds, pool);
    sights.clear();
  };
  while (const std::optional<int> frame = cursor.next()) {
    if (stop_requested()) break;
    sights.push_back(sight_of(job, *frame));
    if (sights.size() == kFramesAtOnce) narrow();
  }
  narrow();
  return bounds;
}

}  // namespace hybridrt::cli
