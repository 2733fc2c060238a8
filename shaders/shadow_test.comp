#version 450 core
// Pass 2, second step: is the pixel's point lit, according to the shadow map? Done once per pixel from its id, not
// once per fragment while rasterising.
#include "scene.glsl"
#include "shadow_warp.glsl"

layout(binding = HRT_UNIT_SHADOW_MAP) uniform sampler2D shadow_map;
layout(binding = HRT_IMAGE_OUT, r8ui) uniform writeonly uimage2D mask;

uniform mat4 map_from_eye;  // u w, v w, depth, w
uniform MapFit fit;
uniform vec3 to_light;

uint shadow_mask(ivec2 pixel) {
  uint id = texelFetch(ids, pixel, 0).r;
  if (id == HRT_NO_TRIANGLE) return HRT_MASK_NO_RECEIVER;
  vec3 dir = pixel_ray(pixel);
  Triangle t = fetch_triangle(id);
  vec3 normal = geometric_normal(t, dir);
  float cos_light = dot(normal, to_light);
  if (cos_light <= 0.0) return 0;  // seen from its unlit side

  vec3 weights = clamped_barycentrics(t.p0, t.p1, t.p2, dir);
  vec3 point = weights.x * t.p0 + weights.y * t.p1 + weights.z * t.p2;
  vec4 in_map = map_from_eye * vec4(point, 1.0);
  vec2 uv = in_map.xy / in_map.w;
  ivec2 size = textureSize(shadow_map, 0);
  ivec2 texel = clamp(ivec2(uv * vec2(size)), ivec2(0), size - 1);
  float w = map_w((float(texel.y) + 0.5) / float(size.y), fit.inverse_w_slope);
  float nearest = (2.0 * texelFetch(shadow_map, texel, 0).r - 1.0) * w;
  return nearest < in_map.z - depth_offset(fit, normal, cos_light, uv.x, w) ? 0u : HRT_MASK_LIT;
}

void main() {
  ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThanEqual(pixel, textureSize(ids, 0)))) return;
  imageStore(mask, pixel, uvec4(shadow_mask(pixel)));
}
