#include "core/image/compare.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <utility>

#include "core/base/check.h"

namespace hybridrt {
namespace {

/// Why the numbers cannot be compared at all, or an empty string.
std::string incomparable(const Image& image, const Image& reference) {
  if (image.width_px != reference.width_px || image.height_px != reference.height_px)
    return fmt::format("the image is {}x{} pixels, the reference {}x{}", image.width_px, image.height_px,
                       reference.width_px, reference.height_px);
  if (image.channels != reference.channels)
    return fmt::format("the image has {} channels, the reference {}", image.channels, reference.channels);
  for (const auto& [name, which] : {std::pair{"image", &image}, std::pair{"reference", &reference}})
    if (const NonFinite at = find_non_finite(*which); at.found)
      return fmt::format("the {} has a value that is not finite at pixel ({}, {}), channel {}", name, at.x, at.y,
                         at.channel);
  return "";
}

}  // namespace

NonFinite find_non_finite(const Image& image) {
  // Blocks without one are passed over by a loop that the compiler turns into vectors.
  constexpr ptrdiff_t kBlock = 1024;
  constexpr uint32_t kExponent = 0x7F800000;
  auto begin = image.data.begin();
  for (; image.data.end() - begin >= kBlock; begin += kBlock) {
    uint32_t largest = 0;
    for (ptrdiff_t i = 0; i < kBlock; ++i) largest = std::max(largest, std::bit_cast<uint32_t>(begin[i]) & kExponent);
    if (largest == kExponent) break;
  }
  const auto bad = std::find_if(begin, image.data.end(), [](float v) { return !std::isfinite(v); });
  if (bad == image.data.end()) return {};
  const size_t index = static_cast<size_t>(bad - image.data.begin());
  const size_t pixel = index / image.channels;
  return {static_cast<int>(pixel % image.width_px), static_cast<int>(pixel / image.width_px),
          static_cast<int>(index % image.channels), true};
}

CompareResult compare_images(const Image& image, const Image& reference, const CompareLimits& limits) {
  CompareResult result;
  result.reason = incomparable(image, reference);
  if (!result.reason.empty()) return result;

  result.measured = true;
  result.pixels = image.pixel_count();
  double sum = 0, sum_of_squares = 0;
  for (int y = 0; y < image.height_px; ++y)
    for (int x = 0; x < image.width_px; ++x) {
      const float* a = image.pixel(x, y);
      const float* b = reference.pixel(x, y);
      double worst = 0;
      for (int c = 0; c < image.channels; ++c) {
        const double off = std::abs(static_cast<double>(a[c]) - b[c]);
        sum += off;
        sum_of_squares += off * off;
        worst = std::max(worst, off);
        if (off > result.max_error) {
          result.max_error = off;
          result.max_x = x, result.max_y = y, result.max_channel = c;
        }
      }
      result.pixels_over_fail += worst > limits.fail;
      result.pixels_over_hard_fail += worst > limits.hard_fail;
    }
  const double values = static_cast<double>(std::max<size_t>(1, image.data.size()));
  result.mean_abs_error = sum / values;
  result.rmse = std::sqrt(sum_of_squares / values);
  result.psnr_db = result.rmse > 0 ? -20 * std::log10(result.rmse) : std::numeric_limits<double>::infinity();

  if (result.pixels_over_hard_fail > 0)
    result.reason =
        fmt::format("{} pixels are off by more than the hard limit {}, the worst by {:.4g} at ({}, {})",
                    result.pixels_over_hard_fail, limits.hard_fail, result.max_error, result.max_x, result.max_y);
  else if (result.percent_over_fail() > limits.fail_percent)
    result.reason = fmt::format("{:.4g} % of the pixels are off by more than {}, {} % are allowed",
                                result.percent_over_fail(), limits.fail, limits.fail_percent);
  result.same = result.reason.empty();
  return result;
}

Image difference_image(const Image& a, const Image& b, double amplification) {
  HRT_CHECK_EQ(a.width_px, b.width_px);
  HRT_CHECK_EQ(a.height_px, b.height_px);
  HRT_CHECK_EQ(a.channels, b.channels);
  HRT_CHECK(a.channels > 0);

  const int colors = a.channels >= 3 ? 3 : 1;
  Image difference(a.width_px, a.height_px, 3);
  for (size_t pixel = 0; pixel < a.pixel_count(); ++pixel) {
    const auto off = [&](int channel) {
      const size_t i = pixel * a.channels + channel;
      const double amplified = amplification * std::abs(static_cast<double>(a.data[i]) - b.data[i]);
      return amplified < 1 ? amplified : 1.0;  // NaN too
    };
    double beyond = 0;
    for (int c = colors; c < a.channels; ++c) beyond = std::max(beyond, off(c));
    for (int c = 0; c < 3; ++c)
      difference.data[pixel * 3 + c] = static_cast<float>(std::min(1.0, off(colors == 3 ? c : 0) + beyond));
  }
  return difference;
}

}  // namespace hybridrt
