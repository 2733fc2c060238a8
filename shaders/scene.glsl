// The scene's arrays and the pixel's ray, as compute passes see them.
#define Real float
#define Vec2 vec2
#define Vec3 vec3
#define HRT_FN
#define HRT_CHOOSE(condition, a, b) ((condition) ? (a) : (b))
#include "shared.h"
#include "surface.glsl"

layout(local_size_x = HRT_GROUP_PX, local_size_y = HRT_GROUP_PX) in;

layout(binding = HRT_UNIT_IDS) uniform usampler2D ids;
layout(binding = HRT_UNIT_POSITIONS) uniform samplerBuffer positions;
layout(binding = HRT_UNIT_TRIANGLE_POSITIONS) uniform usamplerBuffer triangle_positions;

// The eye in scene space, as the sum of two floats: subtracting them one after the other loses nothing.
uniform vec3 eye_high;
uniform vec3 eye_low;

// Direction, not unit, through the centre of the frame's pixel (x, y), row 0 on top: first + x * step_x +
// y * step_y. The picture may be a part of the frame, from its pixel (first_pixel_x, first_pixel_y) on.
uniform vec3 ray_first;
uniform vec3 ray_step_x;
uniform vec3 ray_step_y;
uniform int first_pixel_x;
uniform int first_pixel_y;

vec3 pixel_ray(ivec2 pixel) {
  return ray_first + float(first_pixel_x + pixel.x) * ray_step_x + float(first_pixel_y + pixel.y) * ray_step_y;
}

struct Triangle {
  vec3 p0, p1, p2;  // relative to the eye
};

vec3 position_from_eye(uint index) { return (texelFetch(positions, int(index)).xyz - eye_high) - eye_low; }

Triangle fetch_triangle(uint id) {
  uvec3 corners = texelFetch(triangle_positions, int(id)).xyz;
  return Triangle(position_from_eye(corners.x), position_from_eye(corners.y), position_from_eye(corners.z));
}

// Unit, turned toward the eye.
vec3 geometric_normal(Triangle t, vec3 dir) {
  return turned_toward(normalized_or(cross(t.p1 - t.p0, t.p2 - t.p0), -dir), -dir);
}
