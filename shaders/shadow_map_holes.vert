#version 450 core
// Pass 1, where materials have holes.
#include "holes_vert.glsl"
uniform vec3 origin_high;
uniform vec3 origin_low;
uniform mat4 clip_from_origin;

void main() { gl_Position = clip_from_origin * vec4((corner() - origin_high) - origin_low, 1.0); }
