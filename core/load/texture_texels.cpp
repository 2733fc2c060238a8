#include "core/load/texture_texels.h"

#include <algorithm>

#include "core/image/mip_levels.h"

namespace hybridrt {
namespace {

uint32_t byte_of(uint32_t texel, int i) { return texel >> 8 * i & 255; }

}  // namespace

uint32_t channel_of(uint32_t texel, char channel) {
  switch (channel) {
    case 'r': return byte_of(texel, 0);
    case 'g': return byte_of(texel, 1);
    case 'b': return byte_of(texel, 2);
    case 'm': return byte_of(texel, 3);
  }
  return (byte_of(texel, 0) + byte_of(texel, 1) + byte_of(texel, 2) + 1) / 3;
}

void make_opacity(TexelImage& image, const TextureMap& map) {
  const auto see_through = [](uint32_t texel) { return texel >> 24 != 255; };
  const bool by_alpha = std::any_of(image.texels.begin(), image.texels.end(), see_through);
  const char channel = map.channel ? map.channel : by_alpha ? 'm' : 'l';
  for (uint32_t& texel : image.texels) {
    const float opacity = map.base + map.gain * static_cast<float>(channel_of(texel, channel)) / 255;
    texel = 0xFFFFFFu | static_cast<uint32_t>(std::clamp(opacity, 0.f, 1.f) * 255 + 0.5f) << 24;
  }
}

int draw_checker(std::span<uint32_t> words) {
  for (int y = 0; y < kCheckerSide_px; ++y)
    for (int x = 0; x < kCheckerSide_px; ++x)
      words[static_cast<size_t>(y * kCheckerSide_px + x)] = (x / 8 + y / 8) % 2 ? 0xFFFF00FFu : 0xFF404040u;
  return fill_mip_levels(words, kCheckerSide_px, kCheckerSide_px);
}

bool drop_zero_alpha(TexelImage& image) {
  if (std::any_of(image.texels.begin(), image.texels.end(), [](uint32_t texel) { return texel >> 24 != 0; }))
    return false;
  for (uint32_t& texel : image.texels) texel |= 0xFF000000u;
  return true;
}

}  // namespace hybridrt
