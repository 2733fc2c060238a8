#version 450 core
// Pass 2, second step: is the pixel's point lit, according to the shadow map? Done once per pixel from its id, not
// once per fragment while rasterising.
#include "scene.glsl"
#include "shadow_warp.glsl"

layout(binding = HRT_UNIT_SHADOW_MAP) uniform sampler2D shadow_map;
layout(binding = HRT_IMAGE_OUT, r8ui) uniform writeonly uimage2D mask;

// As in ShadowMapFit.
uniform mat4 map_from_eye;  // u w, v w, depth, w
uniform float inverse_w_slope;
uniform float texel_across;
uniform float texel_along;
uniform float uniform_texel;
uniform float misplacement;
uniform float lean_first;
uniform float lean_step;
uniform int warped;
uniform vec3 across;
uniform vec3 along;
uniform vec3 to_light;

const float kMaxSlope = 20.0;  // bounds the offset where light grazes

// How much nearer than the point the map may be without shadow: it holds the depth at a texel's centre only.
float depth_offset(vec3 normal, float cos_light, float u, float w) {
  vec2 texel = texel_size(texel_across, texel_along, w);
  float widest = max(texel.x, texel.y);
  if (warped == 0) {  // a centre is up to 0.71 texels away along the slope
    float slope = sqrt(max(1.0 - cos_light * cos_light, 0.0)) / cos_light;
    return widest * (min(slope, kMaxSlope) + 0.2);
  }
  vec2 gradient = vec2(dot(normal, across), dot(normal, along)) / cos_light;
  float misplaced = misplacement * w * (1.0 + min(length(gradient), kMaxSlope));
  float half_texel = 0.5 * depth_over_texel(gradient, texel, lean_first + lean_step * u);
  return min(half_texel, kMaxSlope * uniform_texel) + max(0.2 * widest, misplaced);
}

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
  float w = map_w((float(texel.y) + 0.5) / float(size.y), inverse_w_slope);
  float nearest = (2.0 * texelFetch(shadow_map, texel, 0).r - 1.0) * w;
  return nearest < in_map.z - depth_offset(normal, cos_light, uv.x, w) ? 0u : HRT_MASK_LIT;
}

void main() {
  ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThanEqual(pixel, textureSize(ids, 0)))) return;
  imageStore(mask, pixel, uvec4(shadow_mask(pixel)));
}
