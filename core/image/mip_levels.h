#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

namespace hybridrt {

/// `texels`, mip_texel_count() of them, begin with an image (see TexelImage). Fills in its coarser levels behind it,
/// each half as wide and high (rounded down, at least 1), down to a single texel; returns how many levels there are.
///
/// A box filter, in linear light: a texel is the average of exactly the area that it covers, odd sizes too. Colours are
/// weighted by alpha (plus 1/4 of a step), so that colours inside holes do not bleed out.
int fill_mip_levels(std::span<uint32_t> texels, int width_px, int height_px);

/// Texels of all levels of such an image.
uint64_t mip_texel_count(int width_px, int height_px);

}  // namespace hybridrt
