#include "core/procedural/paint.h"

namespace hybridrt {

Material painted(std::string name, const vec3& kd, bool mirror) {
  Material m;
  m.name = std::move(name);
  m.kd = kd, m.ks = vec3(0.15f), m.ns = 40;
  if (mirror) make_mirror(m);
  resolve_material(m);
  return m;
}

void make_mirror(Material& m) {
  m.name += "_mirror";
  m.kd *= 0.5f, m.ks = vec3(0.5f), m.ns = 200, m.illum = 3;
}

}  // namespace hybridrt
