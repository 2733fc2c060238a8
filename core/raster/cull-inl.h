// See lanes-inl.h for the toggle.
#if defined(HYBRIDRT_RASTER_CULL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef HYBRIDRT_RASTER_CULL_H
#undef HYBRIDRT_RASTER_CULL_H
#else
#define HYBRIDRT_RASTER_CULL_H
#endif

#include <cmath>

#include "core/raster/bin_single.h"
#include "core/raster/bins.h"
#include "core/raster/clusters.h"
#include "core/raster/lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace hybridrt {
namespace HWY_NAMESPACE {

/// Finds the clusters that may be seen, many at once, and puts them into the bins of one worker. All of it errs on the
/// side of seeing: boxes grow by more than single precision can be off.
class ClusterCuller {
 public:
  ClusterCuller(const Scene& scene, const Clusters& clusters, const Screen& screen, int worker, FrameBins& bins)
      : scene_(scene), clusters_(clusters), screen_(screen), worker_(worker), bins_(bins) {
    const dvec3* axes[3] = {&screen.right, &screen.up, &screen.forward};
    for (int k = 0; k < 3; ++k) {
      eye_[k] = static_cast<float>(screen.eye[k]);
      for (int axis = 0; axis < 3; ++axis) axes_[axis][k] = static_cast<float>((*axes[axis])[k]);
    }
    // The eye, rounded to float; then what every pixel position is rounded by.
    eye_error_ = 0x1p-22f * (std::abs(eye_[0]) + std::abs(eye_[1]) + std::abs(eye_[2]));
    const double pixels = screen.width_px + screen.height_px + std::abs(screen.middle_x) + std::abs(screen.middle_y);
    pixel_error_ = static_cast<float>(screen.spread_px + 1.0 / 64 + 2e-6 * pixels);
    // Tangents of the picture's sides, half a pixel and some rounding beyond the outer samples.
    const double beyond = 0.5 + screen.spread_px;
    left_ = outward((-beyond - screen.middle_x) / screen.scale_x, -1);
    right_ = outward((screen.width_px - 1 + beyond - screen.middle_x) / screen.scale_x, 1);
    bottom_ = outward((screen.middle_y - screen.height_px + 1 - beyond) / screen.scale_y, -1);
    top_ = outward((screen.middle_y + beyond) / screen.scale_y, 1);
  }

  void cull(size_t begin, size_t end) {
    if (!screen_.fits_float) {
      for (size_t c = begin; c < end; ++c) bin_singly(c);
      return;
    }
    for (size_t c = begin; c < end; c += kLanes) cull_lanes(c, static_cast<int>(std::min<size_t>(end - c, kLanes)));
  }

 private:
  static float outward(double tangent, int side) {
    return static_cast<float>(tangent + side * 1e-5 * (1 + std::abs(tangent)));
  }

  void bin_singly(size_t cluster) { bin_triangles(scene_, clusters_, cluster, screen_, worker_, bins_); }

  Floats along(int axis, Floats x, Floats y, Floats z) const {
    return all(axes_[axis][0]) * x + (all(axes_[axis][1]) * y + all(axes_[axis][2]) * z);
  }
  Floats half_along(int axis, Floats x, Floats y, Floats z) const {
    return all(std::abs(axes_[axis][0])) * x + (all(std::abs(axes_[axis][1])) * y + all(std::abs(axes_[axis][2])) * z);
  }

  /// Of a box from `lo` to `hi` at distances `near` to `far`: whether some part may lie between the two tangents.
  static Mask between(Floats lo, Floats hi, Floats near, Floats far, float low_side, float high_side) {
    const Floats most = hn::Max(all(high_side) * near, all(high_side) * far);
    const Floats least = hn::Min(all(low_side) * near, all(low_side) * far);
    return hn::And(hn::Le(lo, most), hn::Le(least, hi));
  }

  void cull_lanes(size_t first, int count) {
    Floats d[3], e[3];
    for (int k = 0; k < 3; ++k) {
      d[k] = load(&clusters_.center[k][first]) - all(eye_[k]);
      e[k] = load(&clusters_.extent[k][first]);
    }
    const Floats size = (hn::Abs(d[0]) + hn::Abs(d[1])) + (hn::Abs(d[2]) + (e[0] + (e[1] + e[2])));
    const Floats grow = size * all(1e-6f) + all(eye_error_);
    for (Floats& half : e) half = half + grow;
    const Floats x = along(0, d[0], d[1], d[2]), y = along(1, d[0], d[1], d[2]), z = along(2, d[0], d[1], d[2]);
    const Floats half_x = half_along(0, e[0], e[1], e[2]), half_y = half_along(1, e[0], e[1], e[2]);
    const Floats half_z = half_along(2, e[0], e[1], e[2]);
    const Floats near = z - half_z, far = z + half_z;
    Mask seen = hn::And(hn::Gt(far, all(0)), first_lanes(count));
    seen = hn::And(seen, between(x - half_x, x + half_x, near, far, left_, right_));
    seen = hn::And(seen, between(y - half_y, y + half_y, near, far, bottom_, top_));
    if (hn::AllFalse(kFloats, seen)) return;

    // The box's rectangle on the screen, where all of it lies before the eye.
    const Mask in_front = hn::Gt(near, all(0));
    const Floats per_near = all(1) / hn::Max(near, all(1e-30f)), per_far = all(1) / far;
    const auto lower = [&](Floats v) { return v * hn::IfThenElse(hn::Lt(v, all(0)), per_near, per_far); };
    const auto upper = [&](Floats v) { return v * hn::IfThenElse(hn::Lt(v, all(0)), per_far, per_near); };
    const Floats scale_x = all(static_cast<float>(screen_.scale_x)), scale_y = all(static_cast<float>(screen_.scale_y));
    const Floats middle_x = all(static_cast<float>(screen_.middle_x)),
                 middle_y = all(static_cast<float>(screen_.middle_y));
    const auto slack = [&](Floats v) { return hn::Abs(v) * all(4e-6f) + all(pixel_error_); };
    const Floats raw_x0 = lower(x - half_x) * scale_x + middle_x, raw_x1 = upper(x + half_x) * scale_x + middle_x;
    const Floats raw_y0 = middle_y - upper(y + half_y) * scale_y, raw_y1 = middle_y - lower(y - half_y) * scale_y;
    const Floats last_x = all(static_cast<float>(screen_.width_px - 1));
    const Floats last_y = all(static_cast<float>(screen_.height_px - 1));
    const Floats x0 = hn::IfThenElseZero(in_front, hn::Max(hn::Ceil(raw_x0 - slack(raw_x0)), all(0)));
    const Floats y0 = hn::IfThenElseZero(in_front, hn::Max(hn::Ceil(raw_y0 - slack(raw_y0)), all(0)));
    const Floats x1 = hn::IfThenElse(in_front, hn::Min(hn::Floor(raw_x1 + slack(raw_x1)), last_x), last_x);
    const Floats y1 = hn::IfThenElse(in_front, hn::Min(hn::Floor(raw_y1 + slack(raw_y1)), last_y), last_y);
    seen = hn::And(seen, hn::And(hn::Le(x0, x1), hn::Le(y0, y1)));

    // Whether the offsets of its vertices are small enough to be projected in float. Either answer is right; this one
    // is quick (see ClusterDraw for the error's bound).
    const Floats radius = load(&clusters_.radius[first]);
    const Floats error_pixels = ((z + radius) * per_near) * ((radius * per_near) * hn::Max(scale_x, scale_y));
    const uint32_t precise = bits_of(hn::And(in_front, hn::Lt(error_pixels, all(9000))));

    HWY_ALIGN float boxes[4][kLongestVector], nearest[kLongestVector];
    store(boxes[0], x0), store(boxes[1], y0), store(boxes[2], x1), store(boxes[3], y1);
    store(nearest, per_near * all(static_cast<float>(screen_.unit * (1 + 1e-5))));
    for (uint32_t rest = bits_of(seen); rest != 0; rest &= rest - 1) {
      const int i = __builtin_ctz(rest);
      if (precise >> i & 1)
        add_to_tiles(bins_, worker_,
                     {nearest[i], static_cast<uint32_t>(first + i), -1, static_cast<uint16_t>(boxes[0][i]),
                      static_cast<uint16_t>(boxes[1][i]), static_cast<uint16_t>(boxes[2][i]),
                      static_cast<uint16_t>(boxes[3][i])});
      else
        bin_singly(first + i);
    }
  }

  const Scene& scene_;
  const Clusters& clusters_;
  const Screen& screen_;
  const int worker_;
  FrameBins& bins_;
  float eye_[3], axes_[3][3], eye_error_, pixel_error_;
  float left_, right_, bottom_, top_;
};

}  // namespace HWY_NAMESPACE
}  // namespace hybridrt
HWY_AFTER_NAMESPACE();

#endif
