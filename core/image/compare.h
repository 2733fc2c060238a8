#pragma once

#include <string>

#include "core/image/image.h"

namespace hybridrt {

/// Values are compared as their file stores them, on its own 0-1 scale: display values (after the sRGB curve) for PNG
/// and similar formats, linear values for EXR. So a limit of 0.004 is one step of 8 bits, dark or light.
struct CompareLimits {
  double fail = 0.004;        ///< a pixel fails when any channel is off by more
  double fail_percent = 0.1;  ///< how many percent of the pixels may fail
  double hard_fail = 0.1;     ///< no pixel at all may be off by more
};

struct CompareResult {
  bool same = false;
  std::string reason;     ///< why they differ, one sentence without a full stop; empty when the same
  bool measured = false;  ///< false when sizes or channels differ or a value is not finite: no numbers then

  double mean_abs_error = 0;  ///< over all channels of all pixels, as are the next two
  double rmse = 0;
  double psnr_db = 0;  ///< against a peak of 1; infinite for equal images
  double max_error = 0;
  int max_x = 0, max_y = 0, max_channel = 0;  ///< where `max_error` occurs first
  size_t pixels = 0, pixels_over_fail = 0, pixels_over_hard_fail = 0;

  double percent_over_fail() const { return pixels ? 100.0 * pixels_over_fail / pixels : 0; }
  double percent_over_hard_fail() const { return pixels ? 100.0 * pixels_over_hard_fail / pixels : 0; }
};

/// Never throws because of what the images hold: a different size or channel count, or a non-finite value in either,
/// makes them differ, and `reason` says so.
CompareResult compare_images(const Image& image, const Image& reference, const CompareLimits& limits = {});

/// Three channels of min(1, `amplification` * |a - b|): colours by channel, grey repeated, further channels (alpha)
/// added to all three. A difference that is not finite shows white. Same size and channels.
Image difference_image(const Image& a, const Image& b, double amplification);

struct NonFinite {
  int x = 0, y = 0, channel = 0;
  bool found = false;
};

/// The first NaN or infinite value in reading order.
NonFinite find_non_finite(const Image& image);

}  // namespace hybridrt
