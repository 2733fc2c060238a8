#version 450 core
// The nearest and the farthest depth seen per block of pixels, to which pass 1 fits a warped shadow map.
#include "shared.h"
layout(local_size_x = HRT_GROUP_PX, local_size_y = HRT_GROUP_PX) in;

layout(binding = HRT_UNIT_DEPTH) uniform sampler2D depth;  // reversed: 0 where nothing is seen
layout(binding = HRT_IMAGE_OUT, rg32f) uniform writeonly image2D blocks;

void main() {
  ivec2 block = ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThanEqual(block, imageSize(blocks)))) return;
  ivec2 first = block * HRT_RECEIVER_BLOCK_PX;
  ivec2 end = min(first + HRT_RECEIVER_BLOCK_PX, textureSize(depth, 0));
  float nearest = 0.0;
  float farthest = 2.0;
  for (int y = first.y; y < end.y; ++y)
    for (int x = first.x; x < end.x; ++x) {
      float seen = texelFetch(depth, ivec2(x, y), 0).r;
      if (seen == 0.0) continue;
      nearest = max(nearest, seen);
      farthest = min(farthest, seen);
    }
  imageStore(blocks, block, vec4(nearest, farthest, 0.0, 0.0));
}
