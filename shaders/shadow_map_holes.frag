#version 450 core
#include "holes_frag.glsl"

void main() {
  if (in_hole()) discard;
}
