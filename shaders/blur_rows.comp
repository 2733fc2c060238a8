#version 450 core
// Pass 3, first step: the k x k box blur of the shadow mask, along rows. Kept as whole numbers (lit pixels
// and receivers in the window), so that "strictly between dark and lit" is exact.
#include "shared.h"
layout(local_size_x = HRT_GROUP_PX, local_size_y = HRT_GROUP_PX) in;

layout(binding = HRT_UNIT_MASK) uniform usampler2DArray mask;  // a layer per light
layout(binding = HRT_IMAGE_OUT, rg8ui) uniform writeonly uimage2D row_sums;
uniform int radius_px;
uniform int layer;

void main() {
  ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
  ivec2 size = textureSize(mask, 0).xy;
  if (any(greaterThanEqual(pixel, size))) return;
  uint lit = 0;
  uint receivers = 0;
  int last = min(pixel.x + radius_px, size.x - 1);
  for (int x = max(pixel.x - radius_px, 0); x <= last; ++x) {
    uint value = texelFetch(mask, ivec3(x, pixel.y, layer), 0).r;
    lit += value & HRT_MASK_LIT;
    receivers += value == HRT_MASK_NO_RECEIVER ? 0u : 1u;
  }
  imageStore(row_sums, pixel, uvec4(lit, receivers, 0, 0));
}
