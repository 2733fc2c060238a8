// The words of all textures, as a 2-D texture, which may be larger than a buffer texture.
#include "shared.h"
layout(binding = HRT_UNIT_TEXTURE_WORDS) uniform usampler2D texture_words;

uint texture_word(uint i) {
  uint width_shift = uint(HRT_TEXTURE_WORDS_WIDTH_SHIFT);
  return texelFetch(texture_words, ivec2(i & ((1u << width_shift) - 1u), i >> width_shift), 0).r;
}
uint texel_word(uint i) { return texture_word(i); }

#define Int int
#define Uint uint
#define HRT_ANY(condition) (condition)
#include "texture.glsl"
