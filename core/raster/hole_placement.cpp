#include "core/raster/hole_placement.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "shaders/shared.h"

namespace hybridrt {

HolePlacement hole_placement(const Textures& textures, uint32_t triangle) {
  const uint32_t* const words = textures.words.data();
  const uint32_t* const record = words + words[textures.triangle_maps[triangle] + HRT_MAP_HOLES];
  const uvec3& corners = textures.triangle_texcoords[triangle];
  HolePlacement made;
  made.size[0] = static_cast<int32_t>(record[HRT_TEXTURE_WIDTH]);
  made.size[1] = static_cast<int32_t>(record[HRT_TEXTURE_HEIGHT]);
  made.first = static_cast<int32_t>(record[HRT_TEXTURE_FIRST]);
  made.clamped = (record[HRT_TEXTURE_FLAGS] & HRT_TEXTURE_CLAMPED) != 0;
  for (int axis = 0; axis < 2; ++axis) {
    const double scale = std::bit_cast<float>(record[HRT_TEXTURE_SCALE + axis]);
    const double offset = std::bit_cast<float>(record[HRT_TEXTURE_OFFSET + axis]);
    const double size = made.size[axis];
    double place[3], largest = 0;
    for (int k = 0; k < 3; ++k) {
      const double scaled = textures.texcoords[corners[k]][axis] * scale;
      place[k] = axis == 0 ? scaled + offset : 1 - (scaled + offset);
      largest = std::max(largest, std::abs(scaled));
    }
    const double start = made.clamped ? place[0] : place[0] - std::floor(place[0]);
    made.start[axis] = static_cast<float>(start * size);
    for (int k = 0; k < 2; ++k) made.to[k][axis] = static_cast<float>((place[k + 1] - place[0]) * size);
    made.error[axis] = static_cast<float>(0x1p-48 * (largest + std::abs(offset) + 2) * size);
  }
  return made;
}

}  // namespace hybridrt
