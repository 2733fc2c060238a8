#pragma once

#include <cstdint>
#include <span>

#include "core/image/texel_image.h"
#include "core/scene/texture_map.h"

namespace hybridrt {

/// A texel (red in its lowest byte, alpha in its highest) as the map's -imfchan sees it: 'r', 'g', 'b', 'm' for alpha,
/// else the mean of the colours.
uint32_t channel_of(uint32_t texel, char channel);

/// Stores each texel's opacity, as map_d gives it, in its alpha.
void make_opacity(TexelImage& image, const TextureMap& map);

/// An alpha of 0 in every texel is a channel that nobody filled in: it becomes opaque. Whether it was so.
bool drop_zero_alpha(TexelImage& image);

inline constexpr int kCheckerSide_px = 64;

/// A checker of eight by eight squares, with its levels; returns how many.
int draw_checker(std::span<uint32_t> words);

}  // namespace hybridrt
