#version 450 core
#include "shade.glsl"
