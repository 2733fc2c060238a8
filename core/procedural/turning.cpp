#include "core/procedural/turning.h"

#include <algorithm>

namespace hybridrt {

dvec2 ProfileSpan::at(double u) const {
  if (u <= 0) return from;
  if (u >= 1) return to;
  if (is_curve) {
    const double w = 1 - u;
    return w * w * w * from + 3 * w * w * u * control_1 + 3 * w * u * u * control_2 + u * u * u * to;
  }
  if (bulge == 0) return from + u * (to - from);
  // Turns around the centre, which lies on the chord's perpendicular; the angle is 4 atan(bulge).
  const dvec2 chord = to - from, middle = 0.5 * (from + to), right(chord.y, -chord.x);
  const dvec2 center = middle - right * ((1 - bulge * bulge) / (4 * bulge));
  const double angle = 4 * std::atan(bulge) * u, c = std::cos(angle), s = std::sin(angle);
  const dvec2 arm = from - center;
  return center + dvec2(c * arm.x - s * arm.y, s * arm.x + c * arm.y);
}

double ProfileSpan::length() const {
  double length = 0;
  for (int i = 0; i < 16; ++i) length += glm::distance(at(i / 16.0), at((i + 1) / 16.0));
  return length;
}

double ProfileSpan::turning_rad() const {
  if (!is_curve) return std::abs(4 * std::atan(bulge));
  double turning = 0;
  for (int i = 1; i < 16; ++i) {
    const dvec2 a = at(i / 16.0) - at((i - 1) / 16.0), b = at((i + 1) / 16.0) - at(i / 16.0);
    turning += std::abs(std::atan2(a.x * b.y - a.y * b.x, glm::dot(a, b)));
  }
  return turning;
}

void Profile::add(ProfileSpan span, dvec2 to) {
  span.from = end_, span.to = end_ = to;
  span.lift_from = lift_, span.lift_to = lift_ = next_lift_;
  spans_.push_back(span);
}

Profile& Profile::line(dvec2 to) {
  add({}, to);
  return *this;
}

Profile& Profile::arc(dvec2 to, double bulge) {
  ProfileSpan span;
  span.bulge = bulge;
  add(span, to);
  return *this;
}

Profile& Profile::curve(dvec2 control_1, dvec2 control_2, dvec2 to) {
  ProfileSpan span;
  span.is_curve = true, span.control_1 = control_1, span.control_2 = control_2;
  add(span, to);
  return *this;
}

Profile& Profile::ball(double radius) {
  const double center_y = end_.y + std::sqrt(radius * radius - end_.x * end_.x);
  return arc({0, center_y + radius}, std::tan((kPi - std::asin(end_.x / radius)) / 4));
}

Profile& Profile::bead(double height, double out) { return arc(end_ + dvec2(0, height), 2 * out / height); }

Outline circle() {
  Outline outline;
  outline.direction = [](int, double v) { return dvec2(std::cos(2 * kPi * v), std::sin(2 * kPi * v)); };
  outline.fewest_columns = 6;
  return outline;
}

Outline square() {
  Outline outline;
  outline.direction = [](int stretch, double v) {
    constexpr dvec2 kCorners[] = {{1, -1}, {1, 1}, {-1, 1}, {-1, -1}, {1, -1}};
    return glm::mix(kCorners[stretch], kCorners[stretch + 1], v);
  };
  outline.stretches = 4;
  outline.relative_columns = 0;
  return outline;
}

int Fineness::columns(const Outline& outline) const {
  return std::max(outline.fewest_columns,
                  static_cast<int>(std::lround(per_turn * outline.relative_columns / outline.stretches)));
}

int Fineness::rows(const ProfileSpan& span) const {
  if (!span.is_curve && span.bulge == 0) return 1;
  // A cell's height should follow both the span's length and how much the surface turns there.
  const double by_turning = span.turning_rad() * per_turn / (2 * kPi), by_length = span.length() * per_unit;
  return std::max(1, static_cast<int>(std::lround(0.5 * (by_turning + by_length))));
}

namespace {

/// Drops the spans that are too short to matter and joins their neighbours.
std::vector<ProfileSpan> without_details(const std::vector<ProfileSpan>& spans, double smallest) {
  std::vector<ProfileSpan> kept;
  dvec2 end = spans.front().from;
  for (const ProfileSpan& span : spans) {
    if (span.length() < smallest && span.lift_from == 0 && span.lift_to == 0) {
      if (glm::distance(end, span.to) < smallest) continue;
      kept.push_back({});
    } else {
      kept.push_back(span);
    }
    kept.back().from = end, kept.back().to = end = span.to;
  }
  kept.back().to = spans.back().to;
  return kept;
}

}  // namespace

std::vector<Patch> turned(const Profile& profile, const Outline& outline, const Fineness& fineness) {
  std::vector<Patch> patches;
  const int columns = fineness.columns(outline);
  for (const ProfileSpan& span : without_details(profile.spans(), fineness.smallest_span()))
    for (int stretch = 0; stretch < outline.stretches; ++stretch) {
      Patch patch;
      patch.rows = fineness.rows(span), patch.columns = columns;
      patch.at = [span, stretch, outline](double u, double v) {
        const dvec2 p = span.at(u), d = outline.direction(stretch, v);
        const double share = glm::mix(span.lift_from, span.lift_to, u);
        const double lift = outline.lift && share != 0 ? share * outline.lift(stretch, v) : 0;
        return dvec3(p.x * d.x, p.y + lift, p.x * d.y);
      };
      patch.point_at_u0 = span.from.x == 0, patch.point_at_u1 = span.to.x == 0;
      patches.push_back(std::move(patch));
    }
  return patches;
}

}  // namespace hybridrt
