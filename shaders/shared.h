// What C++ and GLSL must agree on: compiled by both.
#ifndef HRT_SHADERS_SHARED_H
#define HRT_SHADERS_SHARED_H

// Pixels along each side of a compute work group.
#define HRT_GROUP_PX 8

// Id buffer: the triangle seen at a pixel's centre, or this.
#define HRT_NO_TRIANGLE 0xFFFFFFFFu

// Shadow mask, one byte a pixel. Pass 2 writes LIT or nothing (shadow), or NO_RECEIVER; pass 3 adds MARKED
// where the blurred mask is neither fully lit nor fully dark.
#define HRT_MASK_LIT 1u
#define HRT_MASK_MARKED 2u
#define HRT_MASK_NO_RECEIVER 4u
// Why, for --aov marked: the pixel's point may lie inside a closed body; its triangle was found anew.
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

// Image unit of a compute pass's only output.
#define HRT_IMAGE_OUT 0

// Texels (RGBA32F) a material: (Kd, Ns) (Ks, opacity) (Ke, 0).
#define HRT_MATERIAL_TEXELS 3

#endif
