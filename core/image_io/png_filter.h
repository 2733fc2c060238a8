#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace hybridrt {

/// What a row of a PNG is predicted from, with the standard's numbers (PNG, third edition, section 9.2).
enum class PngFilter : uint8_t { none, sub, up, average, paeth };

/// A row of display codes, the one above it (zeros for the first), and the bytes of a pixel.
struct PngRow {
  const uint8_t* codes;
  const uint8_t* above;
  size_t bytes;
  size_t pixel_bytes;
};

/// Writes the row's type byte and its filtered bytes: 1 + row.bytes.
void filter_row(const PngRow& row, PngFilter filter, uint8_t* out);

/// The same by that one of `filters` whose bytes, taken as signed, have the smallest sum of magnitudes; the first of
/// equals. The heuristic is the standard's (section 12.7). `scratch` is for it alone; `filters` is not empty.
void filter_row_by_sum(const PngRow& row, std::span<const PngFilter> filters, std::vector<uint8_t>& scratch,
                       uint8_t* out);

}  // namespace hybridrt
