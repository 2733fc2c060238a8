#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/image/image.h"

namespace hybridrt {

/// The curve of IEC 61966-2-1, extended below 0 and above 1 by the same formulas; 0-1 maps to 0-1 both ways.
double srgb_from_linear(double linear);
double linear_from_srgb(double display);

/// The 8-bit display code of a linear value, clamped to 0-1 and rounded to nearest. Equal to the formula in double
/// precision, and about forty times as fast. NaN gives 0.
uint8_t srgb8_from_linear(float linear);

/// The index of the alpha channel (last of 2 or of 4), or -1. Alpha is a share, not light: no curve.
int alpha_channel(int channels);

/// The same for interleaved pixels of `channels` values, alpha linear; writes linear.size() codes.
void srgb8_from_linear(std::span<const float> linear, int channels, uint8_t* codes);

/// A whole linear image as 8-bit display codes, interleaved as in `image.data`.
std::vector<uint8_t> srgb8_from_linear(const Image& image);

/// A whole image of display values made linear.
Image linear_from_srgb(Image image);

}  // namespace hybridrt
