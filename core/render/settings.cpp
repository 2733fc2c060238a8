#include "core/render/settings.h"

#include <algorithm>

#include "core/base/error.h"

namespace hybridrt {

PixelRect picture_rect(const RenderSettings& s) { return s.crop.value_or(PixelRect{0, 0, s.width_px, s.height_px}); }

PixelRect rendered_rect(const RenderSettings& s) {
  const PixelRect picture = picture_rect(s);
  const int margin = s.shadows == ShadowMode::blur ? s.blur_kernel_px / 2 : 0;
  const int x0 = std::max(0, picture.x_px - margin), y0 = std::max(0, picture.y_px - margin);
  const int x1 = std::min(s.width_px, picture.x_px + picture.width_px + margin);
  const int y1 = std::min(s.height_px, picture.y_px + picture.height_px + margin);
  return {x0, y0, x1 - x0, y1 - y0};
}

bool renders_part(const RenderSettings& s) {
  const PixelRect part = rendered_rect(s);
  return part.width_px < s.width_px || part.height_px < s.height_px;
}

bool uses_gl(const RenderSettings& s) {
  return s.forms == PassForms::gl && (s.method == Method::hybrid || s.method == Method::raster);
}

bool uses_shadow_map(const RenderSettings& s) { return s.shadows == ShadowMode::map || s.shadows == ShadowMode::blur; }

PixelRect kept_of_rendered(const RenderSettings& s) {
  const PixelRect picture = picture_rect(s), rendered = rendered_rect(s);
  return {picture.x_px - rendered.x_px, picture.y_px - rendered.y_px, picture.width_px, picture.height_px};
}

bool method_takes(Method method, ShadowMode shadows) {
  return method == Method::hybrid || shadows == ShadowMode::none ||
         shadows == (method == Method::raster ? ShadowMode::map : ShadowMode::rays);
}

void require_method_takes(Method method, ShadowMode shadows) {
  if (!method_takes(method, shadows))
    throw error(ErrorKind::usage, "--method {} does not take --shadows {}; it takes {}", name_of(method),
                name_of(shadows), method == Method::raster ? "none, map" : "none, rays");
}

bool takes_edge_samples(const RenderSettings& s) { return s.adaptive && s.samples > 1; }

void require_adaptive_fits(const RenderSettings& s) {
  if (s.adaptive && s.samples == 1)
    throw error(ErrorKind::usage, "--adaptive needs the number of samples that edges get: --samples 8, for instance");
  if (takes_edge_samples(s) && uses_shadow_map(s))
    throw error(ErrorKind::usage,
                "--adaptive does not go with --shadows {}: rays take the samples at edges, and they do not see shadow "
                "maps; use --shadows exact, rays or none, or leave out --adaptive",
                name_of(s.shadows));
}

ShadowMode default_shadows(Method method) {
  switch (method) {
    case Method::hybrid: return ShadowMode::exact;
    case Method::raster: return ShadowMode::map;
    default: return ShadowMode::rays;
  }
}

}  // namespace hybridrt
