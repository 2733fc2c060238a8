#version 450 core
#define HRT_TEXTURED
#include "shade.glsl"
