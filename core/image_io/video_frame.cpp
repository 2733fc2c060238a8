#include "core/image_io/video_frame.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <string_view>

#include "core/image/srgb.h"
#include "core/image_io/encode_image.h"
#include "core/image_io/written_channels.h"

namespace hybridrt {
namespace {

/// A code of 8 bits as a sum over red, green and blue, in units of 2^-16.
struct Weights {
  int red, green, blue, start;

  uint8_t code(const uint8_t* rgb) const {
    return static_cast<uint8_t>((red * rgb[0] + green * rgb[1] + blue * rgb[2] + start) >> 16);
  }
};

int fixed(double x) { return static_cast<int>(std::lround(x * 65536)); }

Weights weights(double red, double green, double blue, double zero) {
  // The middle weight takes up the rounding, so that grey has no colour and white is exact.
  const int r = fixed(red), b = fixed(blue);
  return {r, fixed(red + green + blue) - r - b, b, fixed(zero + 0.5)};
}

void write_planes(const std::vector<uint8_t>& rgb, size_t pixels, uint8_t* plane) {
  constexpr double kRed = 0.2126, kGreen = 0.7152, kBlue = 0.0722;
  constexpr double kLuma = 219.0 / 255, kToBlue = 224.0 / 255 / (2 * (1 - kBlue)),
                   kToRed = 224.0 / 255 / (2 * (1 - kRed));
  const Weights luma = weights(kLuma * kRed, kLuma * kGreen, kLuma * kBlue, 16);
  const Weights to_blue = weights(-kToBlue * kRed, -kToBlue * kGreen, kToBlue * (1 - kBlue), 128);
  const Weights to_red = weights(kToRed * (1 - kRed), -kToRed * kGreen, -kToRed * kBlue, 128);
  for (const Weights& w : {luma, to_blue, to_red}) {
    for (size_t i = 0; i < pixels; ++i) plane[i] = w.code(&rgb[3 * i]);
    plane += pixels;
  }
}

}  // namespace

std::string video_header(VideoFormat format, int width_px, int height_px, FrameRate rate) {
  if (format == VideoFormat::rgb24) return "";
  return fmt::format("YUV4MPEG2 W{} H{} F{}:{} Ip A1:1 C444 XCOLORRANGE=LIMITED\n", width_px, height_px, rate.count,
                     rate.per);
}

std::vector<uint8_t> video_frame(VideoFormat format, const Image& linear, const std::string& name) {
  require_writable_picture(linear, name);
  const std::vector<uint8_t> rgb = srgb8_from_linear(linear.channels == 3 ? linear : with_channels(linear, 3, false));
  if (format == VideoFormat::rgb24) return rgb;
  constexpr std::string_view kFrame = "FRAME\n";
  std::vector<uint8_t> bytes(kFrame.size() + rgb.size());
  std::copy(kFrame.begin(), kFrame.end(), bytes.begin());
  write_planes(rgb, linear.pixel_count(), bytes.data() + kFrame.size());
  return bytes;
}

}  // namespace hybridrt
