// Triangles whose materials may have holes, drawn corner by corner, as texture coordinates belong to corners, not
// to positions. No attributes are bound.
#include "shared.h"
layout(binding = HRT_UNIT_POSITIONS) uniform samplerBuffer positions;
layout(binding = HRT_UNIT_TRIANGLE_POSITIONS) uniform usamplerBuffer triangle_positions;
layout(binding = HRT_UNIT_TEXCOORDS) uniform samplerBuffer texcoords;
layout(binding = HRT_UNIT_TRIANGLE_TEXCOORDS) uniform usamplerBuffer triangle_texcoords;
layout(binding = HRT_UNIT_TRIANGLE_MAPS) uniform usamplerBuffer triangle_maps;

out vec2 texcoord;
flat out uint maps;

// Sets the outputs; returns the corner's position.
vec3 corner() {
  int triangle = gl_VertexID / 3;
  int k = gl_VertexID % 3;
  texcoord = texelFetch(texcoords, int(texelFetch(triangle_texcoords, triangle)[k])).xy;
  maps = texelFetch(triangle_maps, triangle).r;
  return texelFetch(positions, int(texelFetch(triangle_positions, triangle)[k])).xyz;
}
