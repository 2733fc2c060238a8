#pragma once

#include <bit>
#include <cstdint>

namespace hybridrt {

/// The bits of 2^-1/2 as a float: those of x less these have the exponent above their fraction.
inline constexpr int32_t kLeastMantissaBits = 0x3f3504f3;

/// The binary logarithm by operations that round alike on every machine and in every lane of a vector (log2 of
/// surface_lanes-inl.h has the same), as those of the C library do not. x = 2^exponent m, m from 2^-1/2 to 2^1/2; log2
/// m by the series of artanh((m - 1) / (m + 1)). Exact to 2e-7, or to 2^-23 of the result if that is more; whole where
/// x is a power of two. `x` must be > 0, finite and not denormal.
inline float log2_by_series(float x) {
  const auto bits = std::bit_cast<int32_t>(x);
  const int32_t exponent = (bits - kLeastMantissaBits) >> 23;
  const auto m = std::bit_cast<float>(bits - (exponent << 23));
  const float s = (m - 1) / (m + 1), s2 = s * s;
  float series = static_cast<float>(2.8853900817779268 / 9);
  for (const double term : {2.8853900817779268 / 7, 2.8853900817779268 / 5, 2.8853900817779268 / 3, 2.8853900817779268})
    series = series * s2 + static_cast<float>(term);
  return static_cast<float>(exponent) + s * series;
}

}  // namespace hybridrt
