#pragma once

#include "core/scene/view.h"

namespace hybridrt {

/// How far a pixel's samples may lie from its centre, along x and along y, and what rounding adds.
inline constexpr double kSampleSpread_px = 0.5 + 0x1p-10;

/// A view as the rasteriser needs it: where points of the scene fall, in pixels of the picture. Pixel (x, y) is sampled
/// at the point (x, y), or at several around it. Double precision.
struct Screen {
  int width_px = 0, height_px = 0;
  dvec3 eye{0}, right{0}, up{0}, forward{0};
  double scale_x = 1, scale_y = 1;             ///< pixels per tangent; x grows along `right`, y against `up`
  double middle_x = 0, middle_y = 0;           ///< where `forward` points
  dvec2 sample_px{0};                          ///< View::sample_px
  double spread_px = 0;                        ///< pixels have samples as far as this from (x, y), along x and along y
  int x_px = 0, y_px = 0;                      ///< the picture's first pixel in the frame
  dvec3 frame_first{0}, step_x{0}, step_y{0};  ///< see dir()
  double reach = 1;        ///< the longest of these directions; their component along `forward` is 1
  double unit = 1;         ///< a power of two of about the scene's size: depths are kept as unit / distance
  bool fits_float = true;  ///< whether coordinates are so ordinary that single precision neither over- nor underflows

  /// The direction through pixel (x, y), not unit: View::pixel_dir to the bit.
  dvec3 dir(int x, int y) const {
    return frame_first + static_cast<double>(x_px + x) * step_x + static_cast<double>(y_px + y) * step_y;
  }
};

/// `bounds`: of the scene. A picture may be up to 65,536 pixels wide and high.
Screen make_screen(const View& view, const Aabb& bounds, double spread_px = 0);

}  // namespace hybridrt
