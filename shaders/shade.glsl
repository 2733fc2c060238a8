// Pass 5: ambient + each light's shadow * (diffuse + specular) + what pass 4 traced, once per pixel from its id.
// HRT_TEXTURED: some materials have maps. Defined by ShadePass: HRT_LIGHT_COUNT, the number of lights, and HRT_COLORED,
// if the scene has colours that multiply Kd.
#include "scene.glsl"
#include "shade_variant.glsl"
#ifdef HRT_TEXTURED
#include "texture_words.glsl"
#endif

layout(binding = HRT_UNIT_MASK) uniform usampler2DArray mask;  // a layer per light; HRT_MASK_LIT counts
layout(binding = HRT_UNIT_TRACED) uniform sampler2D traced;
layout(binding = HRT_UNIT_NORMALS) uniform samplerBuffer normals;
layout(binding = HRT_UNIT_TRIANGLE_NORMALS) uniform usamplerBuffer triangle_normals;
layout(binding = HRT_UNIT_TRIANGLE_MATERIALS) uniform usamplerBuffer triangle_materials;
layout(binding = HRT_UNIT_MATERIALS) uniform samplerBuffer materials;
layout(binding = HRT_IMAGE_OUT, rgba32f) uniform writeonly image2D picture;

uniform int use_traced;  // 0: pass 4 adds no light
uniform int masked_lights;  // bit i: light i casts shadows, layer i of the mask says where
uniform vec3 to_light[HRT_MAX_LIGHTS];
uniform vec3 light[HRT_MAX_LIGHTS];
uniform vec3 ambient;
uniform vec3 ambient_slope;
uniform vec3 background;

vec3 shading_normal(uint id, vec3 weights, vec3 side) {
  uvec3 corners = texelFetch(triangle_normals, int(id)).xyz;
  vec3 n = weights.x * texelFetch(normals, int(corners.x)).xyz + weights.y * texelFetch(normals, int(corners.y)).xyz +
           weights.z * texelFetch(normals, int(corners.z)).xyz;
  return turned_toward(normalized_or(n, side), side);
}

#ifdef HRT_COLORED
layout(binding = HRT_UNIT_COLORS) uniform samplerBuffer colors;
layout(binding = HRT_UNIT_TRIANGLE_COLORS) uniform usamplerBuffer triangle_colors;

vec3 color_at(uint id, vec3 weights) {
  uvec3 corners = texelFetch(triangle_colors, int(id)).xyz;
  return weights.x * texelFetch(colors, int(corners.x)).rgb + weights.y * texelFetch(colors, int(corners.y)).rgb +
         weights.z * texelFetch(colors, int(corners.z)).rgb;
}
#endif

#ifdef HRT_TEXTURED
layout(binding = HRT_UNIT_TEXCOORDS) uniform samplerBuffer texcoords;
layout(binding = HRT_UNIT_TRIANGLE_TEXCOORDS) uniform usamplerBuffer triangle_texcoords;

uniform float sample_area;  // where its direction's component along the camera's axis is 1

void apply_textures(uint maps, uint id, Triangle t, vec3 weights, vec3 dir, inout vec3 kd, inout vec3 ks,
                    inout vec3 ke) {
  uvec3 corners = texelFetch(triangle_texcoords, int(id)).xyz;
  vec2 t0 = texelFetch(texcoords, int(corners.x)).xy;
  vec2 t1 = texelFetch(texcoords, int(corners.y)).xy;
  vec2 t2 = texelFetch(texcoords, int(corners.z)).xy;
  vec2 uv = weights.x * t0 + weights.y * t1 + weights.z * t2;
  float distance_along = length(weights.x * t.p0 + weights.y * t.p1 + weights.z * t.p2);
  float footprint = pixel_footprint(t.p1 - t.p0, t.p2 - t.p0, t1 - t0, t2 - t0, normalize(dir),
                                    sample_solid_angle(dir, sample_area), distance_along);
  kd = mapped_color(maps, HRT_MAP_DIFFUSE, kd, uv, footprint);
  ks = mapped_color(maps, HRT_MAP_SPECULAR, ks, uv, footprint);
  ke = mapped_color(maps, HRT_MAP_EMITTED, ke, uv, footprint);
}
#endif

bool arrives(int i, ivec2 pixel, vec3 side) {
  if (dot(side, to_light[i]) <= 0.0) return false;  // seen from its unlit side: in shadow
  return (masked_lights >> i & 1) == 0 || (texelFetch(mask, ivec3(pixel, i), 0).r & HRT_MASK_LIT) != 0u;
}

// Colour, and HRT_ALPHA_*.
vec4 shaded(ivec2 pixel, uint id) {
  vec3 dir = pixel_ray(pixel);
  Triangle t = fetch_triangle(id);
  vec3 weights = clamped_barycentrics(t.p0, t.p1, t.p2, dir);
  vec3 side = geometric_normal(t, dir);
  int material = int(texelFetch(triangle_materials, int(id)).r) * HRT_MATERIAL_TEXELS;
  vec4 kd_ns = texelFetch(materials, material);
  vec4 ks_opacity = texelFetch(materials, material + 1);
  vec4 ke_maps = texelFetch(materials, material + 2);
  vec3 kd = kd_ns.rgb;
  vec3 ks = ks_opacity.rgb;
  vec3 ke = ke_maps.rgb;
#ifdef HRT_COLORED
  kd *= color_at(id, weights);
#endif
#ifdef HRT_TEXTURED
  if (ke_maps.a != 0.0) apply_textures(uint(ke_maps.a), id, t, weights, dir, kd, ks, ke);
#endif
  vec3 normal = shading_normal(id, weights, side);
  vec3 color = phong_unlit(kd, ke, ks_opacity.a, ambient_at(ambient, ambient_slope, normal));
  float alpha = HRT_ALPHA_UNLIT;
  for (int i = 0; i < HRT_LIGHT_COUNT; ++i)
    if (arrives(i, pixel, side)) {
      color += phong_light(kd, ks, kd_ns.a, ks_opacity.a, normal, normalize(-dir), to_light[i], light[i]);
      alpha = HRT_ALPHA_LIT;
    }
  return vec4(use_traced != 0 ? color + texelFetch(traced, pixel, 0).rgb : color, alpha);
}

void main() {
  ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThanEqual(pixel, textureSize(ids, 0)))) return;
  uint id = texelFetch(ids, pixel, 0).r;
  vec4 color = id == HRT_NO_TRIANGLE ? vec4(background, HRT_ALPHA_BACKGROUND) : shaded(pixel, id);
  imageStore(picture, pixel, color);
}
