#pragma once

#include <vector>

#include "core/procedural/patch_mesh.h"

namespace hybridrt {

/// A smooth stretch of a profile: a straight line, a circular arc or a cubic Bezier curve. x = distance from the axis,
/// y = height.
struct ProfileSpan {
  dvec2 from{0}, to{0};
  dvec2 control_1{0}, control_2{0};  ///< control points of a curve
  double bulge = 0;                  ///< tan(angle / 4) of an arc; > 0 bends to the right of its direction
  bool is_curve = false;
  double lift_from = 0, lift_to = 0;  ///< share of the outline's lift at the span's ends

  dvec2 at(double u) const;
  double length() const;
  double turning_rad() const;  ///< the angle that its direction turns by
};

/// The profile of a turned body, drawn from the bottom up, outside to the right. Spans that meet at an angle make a
/// sharp edge.
class Profile {
 public:
  explicit Profile(dvec2 start) : end_(start) {}
  Profile& line(dvec2 to);
  Profile& arc(dvec2 to, double bulge);
  Profile& curve(dvec2 control_1, dvec2 control_2, dvec2 to);
  /// From here on points take this share of the outline's lift (the next span blends to it).
  Profile& lift(double share) { return next_lift_ = share, *this; }
  /// A rounded ring of the given height that protrudes from here; ends right above its beginning.
  Profile& bead(double height, double out);
  /// A ball of this radius that rests on the circle reached so far; ends on the axis.
  Profile& ball(double radius);

  const std::vector<ProfileSpan>& spans() const { return spans_; }
  dvec2 end() const { return end_; }

 private:
  void add(ProfileSpan span, dvec2 to);

  dvec2 end_;
  double lift_ = 0, next_lift_ = 0;
  std::vector<ProfileSpan> spans_;
};

/// What a profile is swept along: a closed curve around the axis in `stretches`, smooth ones, each running
/// over v in 0..1 and cut into the same number of cells.
struct Outline {
  /// Away from the axis (x, z), counter-clockwise from x to z; a unit circle for turned work.
  std::function<dvec2(int stretch, double v)> direction;
  /// Height added to lifted points; may be empty.
  std::function<double(int stretch, double v)> lift;
  int stretches = 1;
  double relative_columns = 1;  ///< cells around, relative to a circle's
  int fewest_columns = 1;       ///< in each stretch
};
Outline circle();
/// A square of side 2.
Outline square();

/// How finely to cut.
struct Fineness {
  double per_turn = 32;                       ///< cells around a full circle
  double per_unit = 20;                       ///< cells along a unit of length of curved spans
  int columns(const Outline& outline) const;  ///< in each stretch
  int rows(const ProfileSpan& span) const;
  /// Spans shorter than this are left out.
  double smallest_span() const { return 3 / (per_turn * per_turn); }
};

/// Patches of a solid of revolution, or of a similar solid with another outline. A profile begins and ends on the axis,
/// or is a loop around material that misses the axis. Lines are one cell long, curves are cut by `fineness`, which also
/// says which details are too small for triangles of their own; a profile's two ends always stay.
std::vector<Patch> turned(const Profile& profile, const Outline& outline, const Fineness& fineness);

}  // namespace hybridrt
