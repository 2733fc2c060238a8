// What C++ and GLSL must agree on: compiled by both.
#ifndef HRT_SHADERS_SHARED_H
#define HRT_SHADERS_SHARED_H

// Pixels along each side of a compute work group.
#define HRT_GROUP_PX 8

// Pixels along each side of a block of receivers.
#define HRT_RECEIVER_BLOCK_PX 16

// Id buffer: the triangle seen at a pixel's centre, or this.
#define HRT_NO_TRIANGLE 0xFFFFFFFFu

// Most lights of a scene.
#define HRT_MAX_LIGHTS 8

// Shadow mask, one byte per pixel and light. Pass 2 writes LIT, 0 (shadow) or NO_RECEIVER; pass 3 adds MARKED where
// pass 4 must ask a ray.
// What the alpha of pass 5's picture says of a pixel. No other value is ever written.
#define HRT_ALPHA_BACKGROUND 0.0f
#define HRT_ALPHA_UNLIT 1.0f  // a surface at which no light arrives
#define HRT_ALPHA_LIT 2.0f
#define HRT_MASK_LIT 1u
#define HRT_MASK_MARKED 2u
#define HRT_MASK_NO_RECEIVER 4u
// Reasons for --aov marked: the pixel's point may lie inside a closed body; its triangle was repaired.
#define HRT_MASK_INSIDE 8u
#define HRT_MASK_REPAIRED 16u

// Texture units.
#define HRT_UNIT_IDS 0
#define HRT_UNIT_MASK 1
#define HRT_UNIT_TRACED 2
#define HRT_UNIT_SHADOW_MAP 3
#define HRT_UNIT_POSITIONS 4
#define HRT_UNIT_TRIANGLE_POSITIONS 5
#define HRT_UNIT_NORMALS 6
#define HRT_UNIT_TRIANGLE_NORMALS 7
#define HRT_UNIT_TRIANGLE_MATERIALS 8
#define HRT_UNIT_MATERIALS 9
#define HRT_UNIT_TEXTURE_WORDS 10
#define HRT_UNIT_TEXCOORDS 11
#define HRT_UNIT_TRIANGLE_TEXCOORDS 12
#define HRT_UNIT_TRIANGLE_MAPS 13
#define HRT_UNIT_DEPTH 14
#define HRT_UNIT_COLORS 15
#define HRT_UNIT_TRIANGLE_COLORS 16

// Image unit of a compute pass's only output.
#define HRT_IMAGE_OUT 0

// Texels (RGBA32F) per material: (Kd, Ns) (Ks, opacity) (Ke, texture maps as a number).
#define HRT_MATERIAL_TEXELS 3

// All textures are one array of 32-bit words:
//  - 256 floats: the linear value of each 8-bit display code (sRGB);
//  - a set of maps per material: for each kind the index of its record, or 0;
//  - records, of the words below;
//  - texels, rows from the top, mip levels one after the other, each half as wide and as high (rounded down, at least
//    1): red in the lowest byte, green, blue, alpha.
// The width of the array as a GL texture: word i is at (i % width, i / width).
#define HRT_TEXTURE_WORDS_WIDTH_SHIFT 14

#define HRT_MAP_DIFFUSE 0u
#define HRT_MAP_SPECULAR 1u
#define HRT_MAP_EMITTED 2u
#define HRT_MAP_HOLES 3u
#define HRT_MAP_KINDS 4u

#define HRT_TEXTURE_WIDTH 0u
#define HRT_TEXTURE_HEIGHT 1u
#define HRT_TEXTURE_LEVELS 2u
#define HRT_TEXTURE_FIRST 3u  // texel, as an index of a word
#define HRT_TEXTURE_FLAGS 4u
#define HRT_TEXTURE_SCALE 5u   // two floats: scale of the texture coordinates
#define HRT_TEXTURE_OFFSET 7u  // two floats
#define HRT_TEXTURE_BASE 9u    // float; the value is base + gain * texel
#define HRT_TEXTURE_GAIN 10u
#define HRT_TEXTURE_RECORD 11u

#define HRT_TEXTURE_CLAMPED 1u

#endif
