#pragma once

#include <cstdint>

#include "core/image/srgb.h"

namespace hybridrt {

/// A pixel's 8-bit channels as a texel: grey becomes three equal colours.
inline uint32_t texel_of(const uint8_t* codes, int channels) {
  const uint32_t red = codes[0], green = channels > 2 ? codes[1] : red, blue = channels > 2 ? codes[2] : red;
  const int alpha = alpha_channel(channels);
  return red | green << 8 | blue << 16 | (alpha >= 0 ? uint32_t{codes[alpha]} : 255u) << 24;
}

}  // namespace hybridrt
