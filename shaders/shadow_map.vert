#version 450 core
// Pass 1: depth of the nearest surface as the light sees it.
layout(location = 0) in vec3 position_scene;
uniform mat4 light_clip_from_scene;

void main() { gl_Position = light_clip_from_scene * vec4(position_scene, 1.0); }
