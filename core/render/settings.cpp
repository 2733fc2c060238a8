#include "core/render/settings.h"

#include "core/base/error.h"

namespace hybridrt {

std::string_view name_of(Method method) {
  switch (method) {
    case Method::hybrid: return "hybrid";
    case Method::raster: return "raster";
    case Method::raytrace: return "raytrace";
    case Method::reference: return "reference";
  }
  return "?";
}

std::string_view name_of(ShadowMode shadows) {
  switch (shadows) {
    case ShadowMode::none: return "none";
    case ShadowMode::map: return "map";
    case ShadowMode::blur: return "blur";
    case ShadowMode::rays: return "rays";
  }
  return "?";
}

std::string_view name_of(Accel accel) { return accel == Accel::kdtree ? "kdtree" : "embree"; }

void require_method_takes(Method method, ShadowMode shadows) {
  const bool on_gpu = method == Method::hybrid || method == Method::raster;
  const bool takes = shadows == ShadowMode::none || (shadows == ShadowMode::map && on_gpu) ||
                     (shadows == ShadowMode::blur && method == Method::hybrid) ||
                     (shadows == ShadowMode::rays && method != Method::raster);
  if (!takes)
    throw error(ErrorKind::usage, "--method {} does not take --shadows {}; it takes {}", name_of(method),
                name_of(shadows),
                method == Method::hybrid ? "none, map, blur, rays"
                : method == Method::raster ? "none, map"
                                           : "none, rays");
}

ShadowMode default_shadows(Method method) {
  switch (method) {
    case Method::hybrid: return ShadowMode::blur;
    case Method::raster: return ShadowMode::map;
    default: return ShadowMode::rays;
  }
}

}  // namespace hybridrt
