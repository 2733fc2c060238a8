#include "core/load/mtl_opacity.h"

#include <algorithm>

namespace hybridrt {
namespace {

bool has_map(const Material& m, MapKind kind) {
  return std::any_of(m.maps.begin(), m.maps.end(), [&](const TextureMap& map) { return map.kind == kind; });
}

}  // namespace

OpacityNote settle_opacity(Material& m, const MtlOpacity& given, KindWish wish) {
  const bool refracts_by_name = m.illum == 6 || m.illum == 7;
  const bool maybe_glass = m.illum == 4 || m.illum == 9;
  const bool has_color = (given.has_kd && m.kd != vec3(0)) || has_map(m, MapKind::diffuse);
  const float transparency = std::max(given.transparency, 0.f);
  m.opacity = given.dissolve >= 0 ? given.dissolve : 1 - transparency;
  if (wish == KindWish::opaque) {
    m.opacity = 1;
    if (refracts_by_name || maybe_glass) m.illum = 2;
    return {};
  }
  if (wish == KindWish::glass) {
    if (!refracts_by_name && !maybe_glass) m.illum = 4;
    return {};
  }

  OpacityNote note;
  note.tr_ignored =
      given.dissolve < 0 && transparency == 1 && !refracts_by_name && !given.filters && (has_color || !maybe_glass);
  if (note.tr_ignored) m.opacity = 1;
  note.illum_ignored = maybe_glass && has_color && m.opacity == 1 && !given.filters && !has_map(m, MapKind::holes);
  if (note.illum_ignored) m.illum = 2;
  return note;
}

}  // namespace hybridrt
