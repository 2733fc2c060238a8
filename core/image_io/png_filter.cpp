#include "core/image_io/png_filter.h"

#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <hwy/highway.h>
#include <limits>

namespace hybridrt {
namespace {

uint8_t paeth(int left, int above, int corner) {
  const int off_left = std::abs(above - corner), off_above = std::abs(left - corner),
            off_corner = std::abs(left + above - 2 * corner);
  if (off_left <= off_above && off_left <= off_corner) return static_cast<uint8_t>(left);
  return static_cast<uint8_t>(off_above <= off_corner ? above : corner);
}

/// `predict(left, above, corner)` for each byte; left of the first pixel all is 0.
template <typename Predict>
void predict_row(const PngRow& row, uint8_t* out, Predict predict) {
  const size_t edge = std::min(row.pixel_bytes, row.bytes);
  for (size_t i = 0; i < edge; ++i) out[i] = static_cast<uint8_t>(row.codes[i] - predict(0, row.above[i], 0));
  const uint8_t *const codes = row.codes + edge, *const left = row.codes;
  const uint8_t *const above = row.above + edge, *const corner = row.above;
  uint8_t* const to = out + edge;
  const size_t count = row.bytes - edge;
  for (size_t i = 0; i < count; ++i) to[i] = static_cast<uint8_t>(codes[i] - predict(left[i], above[i], corner[i]));
}

uint64_t sum_of_magnitudes(const uint8_t* bytes, size_t count) {
  namespace hn = hwy::HWY_NAMESPACE;
  const hn::ScalableTag<uint8_t> tag;
  const hn::Repartition<uint64_t, decltype(tag)> sums_tag;
  auto sums = hn::Zero(sums_tag);
  size_t i = 0;
  for (; i + hn::Lanes(tag) <= count; i += hn::Lanes(tag)) {
    const auto byte = hn::LoadU(tag, bytes + i);
    sums = hn::Add(sums, hn::SumsOf8(hn::Min(byte, hn::Sub(hn::Zero(tag), byte))));
  }
  uint64_t sum = hn::GetLane(hn::SumOfLanes(sums_tag, sums));
  for (; i < count; ++i) sum += std::min(bytes[i], static_cast<uint8_t>(-bytes[i]));
  return sum;
}

}  // namespace

void filter_row(const PngRow& row, PngFilter filter, uint8_t* out) {
  *out++ = static_cast<uint8_t>(filter);
  switch (filter) {
    case PngFilter::none: std::memcpy(out, row.codes, row.bytes); break;
    case PngFilter::sub: predict_row(row, out, [](int left, int, int) { return left; }); break;
    case PngFilter::up: predict_row(row, out, [](int, int above, int) { return above; }); break;
    case PngFilter::average: predict_row(row, out, [](int left, int above, int) { return (left + above) / 2; }); break;
    case PngFilter::paeth: predict_row(row, out, paeth); break;
  }
}

void filter_row_by_sum(const PngRow& row, std::span<const PngFilter> filters, std::vector<uint8_t>& scratch,
                       uint8_t* out) {
  scratch.resize(1 + row.bytes);
  uint64_t least = std::numeric_limits<uint64_t>::max();
  for (const PngFilter filter : filters) {
    filter_row(row, filter, scratch.data());
    const uint64_t sum = sum_of_magnitudes(scratch.data() + 1, row.bytes);
    if (sum >= least) continue;
    least = sum;
    std::memcpy(out, scratch.data(), scratch.size());
  }
}

}  // namespace hybridrt
