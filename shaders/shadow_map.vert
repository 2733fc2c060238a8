#version 450 core
// Pass 1: depth of the nearest surface that the light sees.
layout(location = 0) in vec3 position_scene;
uniform vec3 origin_high;
uniform vec3 origin_low;
uniform mat4 clip_from_origin;

void main() { gl_Position = clip_from_origin * vec4((position_scene - origin_high) - origin_low, 1.0); }
