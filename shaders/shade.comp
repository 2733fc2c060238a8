#version 450 core
// Pass 5: ambient + shadow * (diffuse + specular) + what pass 4 traced, once a pixel from its id.
#include "scene.glsl"

layout(binding = HRT_UNIT_MASK) uniform usampler2D mask;  // HRT_MASK_LIT counts
layout(binding = HRT_UNIT_TRACED) uniform sampler2D traced;
layout(binding = HRT_UNIT_NORMALS) uniform samplerBuffer normals;
layout(binding = HRT_UNIT_TRIANGLE_NORMALS) uniform usamplerBuffer triangle_normals;
layout(binding = HRT_UNIT_TRIANGLE_MATERIALS) uniform usamplerBuffer triangle_materials;
layout(binding = HRT_UNIT_MATERIALS) uniform samplerBuffer materials;
layout(binding = HRT_IMAGE_OUT, rgba32f) uniform writeonly image2D picture;

uniform int use_mask;    // 0: no shadows at all
uniform int use_traced;  // 0: no ray of pass 4 adds light
uniform vec3 to_light;
uniform vec3 light;
uniform vec3 ambient;
uniform vec3 background;

vec3 shading_normal(uint id, vec3 weights, vec3 side) {
  uvec3 corners = texelFetch(triangle_normals, int(id)).xyz;
  vec3 n = weights.x * texelFetch(normals, int(corners.x)).xyz + weights.y * texelFetch(normals, int(corners.y)).xyz +
           weights.z * texelFetch(normals, int(corners.z)).xyz;
  return turned_toward(normalized_or(n, side), side);
}

vec3 shaded(ivec2 pixel, uint id) {
  vec3 dir = pixel_ray(pixel);
  Triangle t = fetch_triangle(id);
  vec3 weights = clamped_barycentrics(t.p0, t.p1, t.p2, dir);
  vec3 side = geometric_normal(t, dir);
  float lit = dot(side, to_light) <= 0.0 ? 0.0 : 1.0;  // seen from its unlit side: in shadow
  if (use_mask != 0 && (texelFetch(mask, pixel, 0).r & HRT_MASK_LIT) == 0u) lit = 0.0;

  int material = int(texelFetch(triangle_materials, int(id)).r) * HRT_MATERIAL_TEXELS;
  vec4 kd_ns = texelFetch(materials, material);
  vec4 ks_opacity = texelFetch(materials, material + 1);
  vec3 ke = texelFetch(materials, material + 2).rgb;
  vec3 color = phong(kd_ns.rgb, ks_opacity.rgb, ke, kd_ns.a, ks_opacity.a, shading_normal(id, weights, side),
                     normalize(-dir), to_light, ambient, light, lit);
  return use_traced != 0 ? color + texelFetch(traced, pixel, 0).rgb : color;
}

void main() {
  ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThanEqual(pixel, textureSize(ids, 0)))) return;
  uint id = texelFetch(ids, pixel, 0).r;
  // Alpha tells a surface from the background.
  vec4 color = id == HRT_NO_TRIANGLE ? vec4(background, 0.0) : vec4(shaded(pixel, id), 1.0);
  imageStore(picture, pixel, color);
}
