#include "core/scene/camera_path.h"

#include <algorithm>
#include <array>

#include "core/base/check.h"

namespace hybridrt {
namespace {

/// The place of a frame: `share` (0..1) of the way from key `from` to the next one.
struct Segment {
  size_t from = 0;
  double share = 0;
};

template <typename FrameOf>
Segment find_segment(size_t count, double frame, const FrameOf& frame_of) {
  HRT_CHECK(count > 0);
  if (count == 1 || frame <= frame_of(0)) return {0, 0};
  if (frame >= frame_of(count - 1)) return {count - 2, 1};
  size_t low = 0, high = count - 1;  // frame_of(low) <= frame < frame_of(high)
  while (high - low > 1) {
    const size_t middle = low + (high - low) / 2;
    (frame_of(middle) <= frame ? low : high) = middle;
  }
  return {low, (frame - frame_of(low)) / (frame_of(high) - frame_of(low))};
}

/// The curve from p[1] to p[2] by Barry and Goldman's pyramid; knots are spaced by the square roots of the distances.
/// Exact at both ends.
dvec3 centripetal_catmull_rom(const std::array<dvec3, 4>& p, double share) {
  if (share <= 0) return p[1];
  if (share >= 1) return p[2];
  const double inner = std::sqrt(glm::distance(p[1], p[2]));
  if (!(inner > 0)) return p[1];
  const double before = std::sqrt(glm::distance(p[0], p[1])), after = std::sqrt(glm::distance(p[2], p[3]));
  const double t = share * inner;  // knots: -before, 0, inner, inner + after
  const auto blend = [t](const dvec3& a, const dvec3& b, double from, double to) {
    return to > from ? ((to - t) * a + (t - from) * b) / (to - from) : b;
  };
  const dvec3 a1 = before > 0 ? blend(p[0], p[1], -before, 0) : p[1];
  const dvec3 a2 = blend(p[1], p[2], 0, inner);
  const dvec3 a3 = after > 0 ? blend(p[2], p[3], inner, inner + after) : p[2];
  const dvec3 b1 = blend(a1, a2, -before, inner);
  const dvec3 b2 = blend(a2, a3, 0, inner + after);
  return blend(b1, b2, 0, inner);
}

/// Interpolates `value(i)` of keys 0..count-1 along the curve, which goes straight on beyond the ends.
template <typename Value>
dvec3 along_curve(size_t count, const Segment& segment, const Value& value) {
  if (count == 1) return value(0);
  const size_t i = segment.from;
  const dvec3 p1 = value(i), p2 = value(i + 1);
  return centripetal_catmull_rom(
      {i > 0 ? value(i - 1) : 2.0 * p1 - p2, p1, p2, i + 2 < count ? value(i + 2) : 2.0 * p2 - p1}, segment.share);
}

/// The same for unit directions. Where the curve goes through zero (opposite keys), that of the earlier key.
template <typename Value>
dvec3 direction_along(size_t count, const Segment& segment, const Value& value) {
  const dvec3 v = along_curve(count, segment, value);
  const double length = glm::length(v);
  return length > 1e-9 ? v / length : glm::normalize(value(segment.from));
}

/// The slope at a key that keeps a cubic monotone: the harmonic mean of the slopes around it, or 0 at a peak.
double monotone_slope(double before, double after) {
  return before * after > 0 ? 2 * before * after / (before + after) : 0;
}

double fov_at(const CameraPath& path, const Segment& segment) {
  const auto& keys = path.keys;
  const auto fov = [&](size_t i) { return keys[i].camera.fov_y_rad; };
  if (keys.size() == 1) return fov(0);
  const auto secant = [&](size_t i) { return (fov(i + 1) - fov(i)) / (keys[i + 1].frame - keys[i].frame); };
  const size_t i = segment.from;
  const double s = segment.share, length = keys[i + 1].frame - keys[i].frame, here = secant(i);
  const double m0 = length * (i > 0 ? monotone_slope(secant(i - 1), here) : here);
  const double m1 = length * (i + 2 < keys.size() ? monotone_slope(here, secant(i + 1)) : here);
  const double value = (1 + 2 * s) * (1 - s) * (1 - s) * fov(i) + s * (1 - s) * (1 - s) * m0 +
                       s * s * (3 - 2 * s) * fov(i + 1) + s * s * (s - 1) * m1;
  return std::clamp(value, std::min(fov(i), fov(i + 1)), std::max(fov(i), fov(i + 1)));
}

}  // namespace

Camera camera_on_path(const CameraPath& path, double frame) {
  const auto& keys = path.keys;
  const Segment segment = find_segment(keys.size(), frame, [&](size_t i) { return keys[i].frame; });
  Camera camera;
  camera.eye_world = along_curve(keys.size(), segment, [&](size_t i) { return keys[i].camera.eye_world; });
  camera.target_world = along_curve(keys.size(), segment, [&](size_t i) { return keys[i].camera.target_world; });
  camera.up = direction_along(keys.size(), segment, [&](size_t i) { return keys[i].camera.up; });
  camera.fov_y_rad = fov_at(path, segment);
  return camera;
}

std::optional<dvec3> light_on_path(const CameraPath& path, double frame) {
  std::vector<const CameraKey*> lit;
  for (const CameraKey& key : path.keys)
    if (key.light_toward) lit.push_back(&key);
  if (lit.empty()) return std::nullopt;
  const Segment segment = find_segment(lit.size(), frame, [&](size_t i) { return lit[i]->frame; });
  return direction_along(lit.size(), segment, [&](size_t i) { return *lit[i]->light_toward; });
}

}  // namespace hybridrt
