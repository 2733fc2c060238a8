#include "core/render/frame.h"

#include <algorithm>

#include "core/base/error.h"

namespace hybridrt {

TraceJob make_trace_job(const Scene& scene, const FramePlan& plan, const RenderSettings& settings) {
  TraceJob job{scene, plan.view, {}, plan.shadows, settings.reflection_depth, settings.ambient, settings.background};
  for (const DirectionalLight& light : plan.lights) job.lights.push_back({light});
  return job;
}

Image picture_from_rgba(const vec4* rgba, int width_px, int height_px, const PixelRect& kept, int64_t& pixels_hit) {
  const auto unwritten = [](const vec4& pixel) { return pixel.a != 1.0f && pixel.a != 0.0f; };
  const size_t count = static_cast<size_t>(width_px) * height_px;
  if (const auto bad = std::count_if(rgba, rgba + count, unwritten))
    throw error(ErrorKind::device, "the GL driver left {} of {} pixels unwritten", bad, count);

  Image picture(kept.width_px, kept.height_px, 3);
  float* out = picture.data.data();
  pixels_hit = 0;
  for (int y = kept.y_px; y < kept.y_px + kept.height_px; ++y) {
    const vec4* row = rgba + static_cast<size_t>(y) * width_px + kept.x_px;
    for (int x = 0; x < kept.width_px; ++x) {
      pixels_hit += row[x].a == 1.0f;
      *out++ = row[x].r;
      *out++ = row[x].g;
      *out++ = row[x].b;
    }
  }
  return picture;
}

}  // namespace hybridrt
