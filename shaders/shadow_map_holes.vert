#version 450 core
// Pass 1, where materials have holes.
#include "holes_vert.glsl"
uniform mat4 light_clip_from_scene;

void main() { gl_Position = light_clip_from_scene * vec4(corner(), 1.0); }
