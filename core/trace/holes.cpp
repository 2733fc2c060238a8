#include "core/trace/holes.h"

#include "core/trace/texture_lookup.h"

namespace hybridrt {

bool is_hole(const Textures& textures, uint32_t triangle, double u, double v) {
  const uint32_t maps = textures.triangle_maps[triangle];
  if (!textures.has_holes(maps)) return false;
  return TextureLookup<double>{textures.words.data()}.has_hole(maps, texcoord_at(textures, triangle, u, v));
}

}  // namespace hybridrt
