#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace hybridrt {

/// `texels` ends with a whole image (see TexelImage) that begins at `first`. Appends its coarser levels, each half as
/// wide and high (rounded down, at least 1), down to a single texel; returns how many levels there are now.
///
/// A box filter, in linear light: a texel is the average of exactly the area that it covers, odd sizes too. Colours are
/// weighted by alpha (plus 1/4 of a step), so that colours inside holes do not bleed out.
int append_mip_levels(std::vector<uint32_t>& texels, size_t first, int width_px, int height_px);

/// Texels of all levels of such an image.
uint64_t mip_texel_count(int width_px, int height_px);

}  // namespace hybridrt
