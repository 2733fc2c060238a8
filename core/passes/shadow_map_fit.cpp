#include "core/passes/shadow_map_fit.h"

#include <algorithm>
#include <glm/gtc/matrix_transform.hpp>
#include <vector>

namespace hybridrt {
namespace {

constexpr double kLeastSine = 0.02;  // view and light nearer to parallel: nothing to gain
// A margin on all sides, since the test's point of a receiver differs slightly from the raster's.
constexpr double kMargin_texels = 2;
// Rounding of the map's depths and of the points': texels narrower than this do not narrow the bias.
constexpr double kDepthRounding = 0x1p-18;
// What rounding adds to a number on its way into the map, as a share of the largest such number.
constexpr double kRounding = 0x1p-23;
constexpr double kMostLean = 4;

struct Range {
  double lo = std::numeric_limits<double>::infinity(), hi = -lo;
  void grow(double x) { lo = std::min(lo, x), hi = std::max(hi, x); }
  void widen(double by) { lo -= by, hi += by; }
  double size() const { return hi - lo; }
};

/// The direction across the light along which the map is warped: away from the eye.
dvec3 warp_axis(const View& view, const dvec3& toward, double& sine) {
  const dvec3 across = view.forward - glm::dot(view.forward, toward) * toward;
  sine = glm::length(across);
  if (sine > kLeastSine) return across / sine;
  return glm::normalize(view.up - glm::dot(view.up, toward) * toward);
}

/// How fast w grows from 1 at the nearest receiver.
double warp_per_length(double sine, double nearest, double length, int size_px) {
  // The margin beyond the farthest receivers must not reach the horizon, where w is infinite.
  const double most_w = size_px / (4 * kMargin_texels);
  if (sine <= kLeastSine || most_w <= 1) return 0;
  const double z0 = std::max(nearest, 0.0), z1 = z0 + length * sine;
  const double pole_distance = (z0 + std::sqrt(z0 * z1)) / sine;
  return 1 / std::max(pole_distance, length / (most_w - 1));
}

/// A receiver's coordinates across and along the warp's axis, and its w.
struct Seen {
  double x, v, w;
};

Range range_across(std::span<const Seen> receivers, double lean, size_t step) {
  Range range;
  for (size_t i = 0; i < receivers.size(); i += step)
    range.grow((receivers[i].x - lean * receivers[i].v) / receivers[i].w);
  return range;
}

/// The lean that makes the receivers narrowest. Their width is a convex function of it: golden-section search. A sample
/// of the receivers is enough, as the map is then fitted to all of them.
double narrowest_lean(std::span<const Seen> receivers) {
  constexpr double kGolden = 0.6180339887498949;
  const size_t step = 1 + receivers.size() / 2048;
  double lo = -kMostLean, hi = kMostLean;
  for (int i = 0; i < 24; ++i) {
    const double a = hi - kGolden * (hi - lo), b = lo + kGolden * (hi - lo);
    const bool left = range_across(receivers, a, step).size() < range_across(receivers, b, step).size();
    (left ? hi : lo) = left ? b : a;
  }
  return 0.5 * (lo + hi);
}

dvec4 row(const dvec3& axis, double offset) { return {axis, offset}; }

dvec3 nearest_of(std::span<const dvec3> points, const dvec3& forward) {
  return *std::min_element(points.begin(), points.end(),
                           [&](const dvec3& a, const dvec3& b) { return glm::dot(a, forward) < glm::dot(b, forward); });
}

}  // namespace

ShadowMapFit uniform_shadow_map(const LightFrame& light, int size_px) {
  const dvec3 box = light.hi - light.lo;
  const dvec2 texel = dvec2(box) / static_cast<double>(size_px) / box.z;
  ShadowMapFit fit;
  fit.origin = 0.5 * (light.lo.x + light.hi.x) * light.x_axis + 0.5 * (light.lo.y + light.hi.y) * light.y_axis -
               0.5 * (light.lo.z + light.hi.z) * light.toward;
  fit.map_from_origin = light.unit_from_scene() * glm::translate(dmat4(1), fit.origin);
  fit.map_from_origin[3][2] = 0;
  fit.across = light.x_axis;
  fit.along = light.y_axis;
  fit.texel_across = texel.x;
  fit.texel_along = texel.y;
  fit.uniform_texel = std::max(texel.x, texel.y);
  return fit;
}

ShadowMapFit fit_shadow_map(const LightFrame& light, const View& view, std::span<const dvec3> receivers, int size_px) {
  if (receivers.empty()) return uniform_shadow_map(light, size_px);
  const dvec3 box = light.hi - light.lo;
  double sine = 0;
  const dvec3 v_axis = warp_axis(view, light.toward, sine), x_axis = glm::cross(v_axis, light.toward);

  const dvec3 nearest = nearest_of(receivers, view.forward);  // the origin, where texels are smallest

  Range along;
  for (const dvec3& p : receivers) along.grow(glm::dot(p - nearest, v_axis));
  const double air = 1e-6 * std::max({box.x, box.y, box.z});  // gives a single point an extent
  along.widen(air);

  const double w_per_length = warp_per_length(sine, glm::dot(nearest, view.forward), along.size(), size_px);
  const double w_hi = 1 + along.size() * w_per_length;
  std::vector<Seen> seen;
  seen.reserve(receivers.size());
  for (const dvec3& p : receivers) {
    const double v = glm::dot(p - nearest, v_axis) - along.lo;
    seen.push_back({glm::dot(p - nearest, x_axis), v, 1 + v * w_per_length});
  }
  const double lean = narrowest_lean(seen);
  Range across = range_across(seen, lean, 1);  // after the division by w
  across.widen(air);

  // Receivers fill the inner part of the map, from `margin` on.
  const double margin = std::min(kMargin_texels, size_px / 8.0) / size_px, inner = 1 - 2 * margin;
  const double decline = 1 - 1 / w_hi;                  // the decline of 1 / w over the inner part
  const double w_scale = 1 + decline * margin / inner;  // w is 1 along the map's first row, not the receivers'

  const dvec4 w = w_scale * row(w_per_length * v_axis, 1 - along.lo * w_per_length);
  const dvec4 v = margin * w + inner * w_scale * w_hi / along.size() * row(v_axis, -along.lo);
  const dvec4 x = w_scale * row(x_axis - lean * v_axis, lean * along.lo);
  const dvec4 u = margin * w + inner / across.size() * (x - across.lo * w);
  const dvec4 z = row(-light.toward, 0) / box.z;

  ShadowMapFit fit;
  fit.origin = view.eye + nearest;
  fit.map_from_origin = glm::transpose(dmat4(u, v, z, w));
  fit.warped = true;
  fit.across = x_axis;
  fit.along = v_axis;
  fit.inverse_w_slope = -decline / (inner * w_scale);
  fit.texel_across = std::max(1 / (glm::dot(dvec3(u), x_axis) * size_px * box.z), kDepthRounding);
  fit.texel_along = 1 / (glm::dot(dvec3(v), v_axis) * size_px * box.z);
  fit.uniform_texel = std::max(box.x, box.y) / size_px / box.z;
  fit.misplacement = kRounding * glm::length(box) / box.z;  // corners may lie a whole scene away
  fit.lean_step = w_per_length * across.size() / inner;
  fit.lean_first = lean + w_per_length * across.lo - margin * fit.lean_step;
  return fit;
}

}  // namespace hybridrt
