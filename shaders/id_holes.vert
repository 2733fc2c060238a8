#version 450 core
// Pass 2, first step, where materials have holes.
#include "holes_vert.glsl"
uniform vec3 eye_high;
uniform vec3 eye_low;
uniform mat4 clip_from_eye;

void main() { gl_Position = clip_from_eye * vec4((corner() - eye_high) - eye_low, 1.0); }
