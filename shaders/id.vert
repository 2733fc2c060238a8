#version 450 core
// Pass 2, first step: which triangle does each pixel see?
layout(location = 0) in vec3 position_scene;
uniform vec3 eye_high;
uniform vec3 eye_low;
uniform mat4 clip_from_eye;

void main() { gl_Position = clip_from_eye * vec4((position_scene - eye_high) - eye_low, 1.0); }
