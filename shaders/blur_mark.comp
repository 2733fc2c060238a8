#version 450 core
// Pass 3, second step: the blur along columns. Marks a receiver whose window holds both light and shadow.
#include "shared.h"
layout(local_size_x = HRT_GROUP_PX, local_size_y = HRT_GROUP_PX) in;

layout(binding = HRT_UNIT_MASK) uniform usampler2DArray mask;  // a layer per light
layout(binding = HRT_UNIT_TRACED) uniform usampler2D row_sums;
layout(binding = HRT_IMAGE_OUT, r8ui) uniform writeonly uimage2D marked_mask;
uniform int radius_px;
uniform int layer;

void main() {
  ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
  ivec2 size = textureSize(mask, 0).xy;
  if (any(greaterThanEqual(pixel, size))) return;
  uint value = texelFetch(mask, ivec3(pixel, layer), 0).r;
  if (value != HRT_MASK_NO_RECEIVER) {
    uvec2 sums = uvec2(0);  // lit pixels, receivers
    int last = min(pixel.y + radius_px, size.y - 1);
    for (int y = max(pixel.y - radius_px, 0); y <= last; ++y) sums += texelFetch(row_sums, ivec2(pixel.x, y), 0).rg;
    if (sums.x > 0 && sums.x < sums.y) value |= HRT_MASK_MARKED;
  }
  imageStore(marked_mask, pixel, uvec4(value));
}
