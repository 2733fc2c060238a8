// Whether a fragment lies in a hole of its triangle.
#define Real float
#define Vec2 vec2
#define Vec3 vec3
#define HRT_FN
#define HRT_CHOOSE(condition, a, b) ((condition) ? (a) : (b))
#include "texture_words.glsl"
#include "texture_holes.glsl"

in vec2 texcoord;
flat in uint maps;

bool in_hole() { return has_hole(maps, texcoord); }
