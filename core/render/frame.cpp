#include "core/render/frame.h"

#include <algorithm>

#include "core/base/error.h"
#include "core/base/timing.h"
#include "shaders/shared.h"

namespace hybridrt {

TraceJob make_trace_job(const Scene& scene, const FramePlan& plan, const RenderSettings& settings) {
  TraceJob job{scene, plan.view, {}, plan.shadows, settings.reflection_depth, settings.ambient, settings.background};
  for (const DirectionalLight& light : plan.lights) job.lights.push_back({light});
  return job;
}

void render_each(const NextFrame& next, const DeliverFrame& deliver,
                 const std::function<Frame(const FrameRequest&)>& render) {
  Stopwatch since_last_frame;
  while (const std::optional<FrameRequest> request = next()) {
    Frame frame = render(*request);
    frame.timings.wall_ms = since_last_frame.elapsed_ms();
    since_last_frame.restart();
    deliver(std::move(frame));
  }
}

Image picture_from_rgba(const vec4* rgba, int width_px, int height_px, const PixelRect& kept, bool with_alpha,
                        TraceStats& stats) {
  const auto unwritten = [](const vec4& pixel) {
    return pixel.a != HRT_ALPHA_BACKGROUND && pixel.a != HRT_ALPHA_UNLIT && pixel.a != HRT_ALPHA_LIT;
  };
  const size_t count = static_cast<size_t>(width_px) * height_px;
  if (const auto bad = std::count_if(rgba, rgba + count, unwritten))
    throw error(ErrorKind::device, "the GL driver left {} of {} pixels unwritten", bad, count);

  Image picture = Image::uninitialized(kept.width_px, kept.height_px, with_alpha ? 4 : 3);
  float* out = picture.data.data();
  stats.pixels_hit = stats.pixels_lit = 0;
  for (int y = kept.y_px; y < kept.y_px + kept.height_px; ++y) {
    const vec4* row = rgba + static_cast<size_t>(y) * width_px + kept.x_px;
    for (int x = 0; x < kept.width_px; ++x) {
      const bool hit = row[x].a != HRT_ALPHA_BACKGROUND;
      stats.pixels_hit += hit;
      stats.pixels_lit += row[x].a == HRT_ALPHA_LIT;
      const vec3 color = with_alpha && !hit ? vec3(0) : vec3(row[x]);
      *out++ = color.r;
      *out++ = color.g;
      *out++ = color.b;
      if (with_alpha) *out++ = hit ? 1.0f : 0.0f;
    }
  }
  return picture;
}

}  // namespace hybridrt
