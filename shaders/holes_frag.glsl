// Whether a fragment lies in a hole of its triangle.
#define Real float
#define Vec2 vec2
#define Vec3 vec3
#define HRT_FN
#include "texture_words.glsl"

in vec2 texcoord;
flat in uint maps;

bool in_hole() { return has_hole(maps, texcoord); }
