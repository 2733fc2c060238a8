#pragma once

#include "core/image/texel_image.h"
#include "core/scene/scene.h"

namespace hybridrt {

inline uint32_t texel_of(uint32_t red, uint32_t green, uint32_t blue, uint32_t alpha = 255) {
  return red | green << 8 | blue << 16 | alpha << 24;
}

/// Pictures without files, by the beginning of a file's name: "noise" 12 x 7 opaque texels of random colour, "leaf"
/// 32 x 32 with round holes, "mask" 8 x 8 in grey, dark and bright by turns, "black" the same all dark, "blank" noise
/// with alpha 0 throughout, "faint" with 100, "torn" refuses.
TexelImage pattern_named(const std::filesystem::path& path, int largest_side_px, uint64_t most_texels);

/// A reader whose sizes are those of what it reads.
TexelFiles texel_files(TexelReader read);

/// `image` as the only texture (map_Kd) of a scene of one triangle, (0,0,0) (1,0,0) (0,1,0), whose texture coordinates
/// are its x and y.
Scene textured_triangle(const TexelImage& image, TextureMap map = {});

/// Gives every second triangle holes; texture coordinates are random.
Scene with_random_holes(Scene scene, uint32_t seed);

/// Gives all triangles holes, each by one of several maps: of 1x1 to 300x200 texels, repeated and clamped, scaled and
/// moved. Texture coordinates are tiny, ordinary, huge, far from 0, or the same at all corners.
Scene with_all_kinds_of_holes(Scene scene, uint32_t seed);

/// A square of `cells` by `cells`, in the plane z = 0 and around 0, of squares that are `step` cells wide. A large
/// map of holes lies over all of it; borders of texels fall into the middle of cells.
Scene sheet_of_holes(int cells, int step, float texels_per_cell, bool clamped);

/// A tiled floor, a leaf with holes over it and a mirror with a map_Ks behind, with all kinds of statements; loaded
/// from OBJ and MTL.
Scene textured_room();

}  // namespace hybridrt
