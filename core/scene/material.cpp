#include "core/scene/material.h"

namespace hybridrt {

void resolve_material(Material& m) {
  const bool mirror = m.illum == 3 || m.illum == 5 || m.illum == 8;
  const bool glass = m.illum == 4 || m.illum == 6 || m.illum == 7 || m.illum == 9;
  if (m.illum == 0 || m.illum == 1) m.ks = vec3(0);

  m.reflect = mirror || glass ? m.ks : vec3(0);
  m.transmit = m.opacity < 1 ? (1 - m.opacity) * m.tf : glass ? m.tf : vec3(0);
  m.fresnel = m.illum == 5 && m.reflect != vec3(0) ? Fresnel::schlick : Fresnel::none;
  if (!glass) m.ni = 1;
  if (glass && m.ni != 1 && m.transmit != vec3(0)) m.fresnel = Fresnel::dielectric;
}

}  // namespace hybridrt
