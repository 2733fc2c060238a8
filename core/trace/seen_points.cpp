#include "core/trace/seen_points.h"

#include <algorithm>

#include "core/base/check.h"
#include "core/trace/surface_at.h"
#include "shaders/shared.h"

// clang-format off: the order matters
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "core/trace/seen_points.cpp"
#include <hwy/foreach_target.h>  // includes this file once for each instruction set
#include <hwy/highway.h>

#include "core/trace/surface_lanes-inl.h"
// clang-format on

HWY_BEFORE_NAMESPACE();
namespace hybridrt {
namespace HWY_NAMESPACE {

using Real = LaneReal<double>;
using Vector = LaneVec3<double>;
constexpr int kDoubles = lane_count<double>();

inline Real largest_part(Vector v) { return max(max(abs(v.x), abs(v.y)), abs(v.z)); }

inline void store_float(Real value, float* to) {
  const hn::Rebind<float, LanesOf<double>> floats;
  hn::StoreU(hn::DemoteTo(floats, value.v), floats, to);
}

/// A whole vector of pixels, from number `first`.
class PointFinder {
 public:
  PointFinder(const Scene& scene, const View& view, std::span<const TracedLight> lights, SeenPoints& points)
      : scene_(scene),
        eye_(view.eye),
        first_(view.ray_first()),
        step_x_(view.ray_step_x()),
        step_y_(view.ray_step_y()),
        x_px_(view.x_px),
        y_px_(view.y_px),
        sample_area_(view.sample_area()),
        lights_(lights),
        points_(points) {}

  void find(int first) {
    const Vector p0 = corner(first, 0), p1 = corner(first, 1), p2 = corner(first, 2);
    const Vector eye = Vector::all(eye_), ray = pixel_dir(first), dir = normalize(ray);
    const Vector weights = surface_doubles::clamped_barycentrics(p0 - eye, p1 - eye, p2 - eye, dir);
    const Vector e1 = p1 - p0, e2 = p2 - p0, normal = cross(e1, e2);
    const auto from_front = dot(normal, dir) <= Real(0);
    const Vector side = choose(from_front, normal, -normal);
    const Vector point = p0 + weights.y * e1 + weights.z * e2;
    const Real reach = max(largest_part(point), max(largest_part(e1), largest_part(e2)));
    const Real length = sqrt(dot(normal, normal));
    const Vector origin = point + (Real(kRelativeOffset<double>) * reach / length) * side;

    origin.x.store(points_.origin[0] + first), origin.y.store(points_.origin[1] + first);
    origin.z.store(points_.origin[2] + first);
    store_float(weights.y, points_.u + first), store_float(weights.z, points_.v + first);
    if (scene_.textures) {
      const Real squared = dot(ray, ray);
      const Vector from_eye = origin - eye;
      store_float(Real(sample_area_) / (squared * sqrt(squared)), points_.solid_angle + first);
      store_float(sqrt(dot(from_eye, from_eye)), points_.distance + first);
    }
    const Vector unit_side = side / length;
    const Real* const dirs[] = {&dir.x, &dir.y, &dir.z};
    const Real* const sides[] = {&unit_side.x, &unit_side.y, &unit_side.z};
    for (int k = 0; k < 3; ++k) {
      store_float(*dirs[k], points_.dir[k] + first);
      store_float(*sides[k], points_.side[k] + first);
    }
    const unsigned front = bits_of(from_front);
    unsigned facing[HRT_MAX_LIGHTS] = {};
    for (size_t l = 0; l < lights_.size(); ++l)
      facing[l] = bits_of(dot(side, Vector::all(lights_[l].light.toward)) > Real(0));
    for (int i = 0; i < kDoubles; ++i) {
      points_.from_front[first + i] = front >> i & 1;
      unsigned lights = 0;
      for (size_t l = 0; l < lights_.size(); ++l) lights |= (facing[l] >> i & 1) << l;
      points_.facing[first + i] = static_cast<uint8_t>(lights);
    }
  }

 private:
  static unsigned bits_of(Real::Mask mask) {
    uint8_t bits[8] = {};
    hn::StoreMaskBits(LanesOf<double>(), mask, bits);
    return bits[0];
  }

  Vector corner(int first, int number) const {
    HWY_ALIGN float values[3][8];
    for (int i = 0; i < kDoubles; ++i) {
      const vec3& p = scene_.positions[scene_.triangle_positions[points_.triangle[first + i]][number]];
      values[0][i] = p.x, values[1][i] = p.y, values[2][i] = p.z;
    }
    const hn::Rebind<float, LanesOf<double>> floats;
    const auto doubled = [&](const float* from) {
      return Real(hn::PromoteTo(LanesOf<double>(), hn::Load(floats, from)));
    };
    return {doubled(values[0]), doubled(values[1]), doubled(values[2])};
  }

  /// View::pixel_dir.
  Vector pixel_dir(int first) const {
    HWY_ALIGN double x[8], y[8];
    for (int i = 0; i < kDoubles; ++i) {
      x[i] = static_cast<double>(x_px_ + points_.x[first + i]);
      y[i] = static_cast<double>(y_px_ + points_.y[first + i]);
    }
    return Vector::all(first_) + Real::load(x) * Vector::all(step_x_) + Real::load(y) * Vector::all(step_y_);
  }

  const Scene& scene_;
  const dvec3 eye_, first_, step_x_, step_y_;
  const int x_px_, y_px_;
  const double sample_area_;
  const std::span<const TracedLight> lights_;
  SeenPoints& points_;
};

void find_in_lanes(const Scene& scene, const View& view, std::span<const TracedLight> lights, SeenPoints& points) {
  PointFinder finder(scene, view, lights, points);
  for (int first = 0; first < points.count; first += kDoubles) finder.find(first);
}

}  // namespace HWY_NAMESPACE
}  // namespace hybridrt
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace hybridrt {

HWY_EXPORT(find_in_lanes);

void find_points(const Scene& scene, const View& view, std::span<const TracedLight> lights, SeenPoints& points) {
  HRT_CHECK(points.count <= SeenPoints::kMost && lights.size() <= HRT_MAX_LIGHTS);
  if (points.count == 0) return;
  for (int i = points.count; i < points.count + 16; ++i) {  // fills up the last vector
    points.triangle[i] = points.triangle[points.count - 1];
    points.x[i] = points.x[points.count - 1], points.y[i] = points.y[points.count - 1];
  }
  HWY_DYNAMIC_DISPATCH(find_in_lanes)(scene, view, lights, points);
}

}  // namespace hybridrt
#endif  // HWY_ONCE
