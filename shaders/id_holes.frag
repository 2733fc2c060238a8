#version 450 core
#include "holes_frag.glsl"
layout(location = 0) out uint id;

void main() {
  if (in_hole()) discard;
  id = uint(gl_PrimitiveID);
}
