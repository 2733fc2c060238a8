#include "core/procedural/chess_knight.h"

#include <algorithm>
#include <initializer_list>
#include <vector>

#include "core/procedural/carving.h"
#include "core/procedural/chess_pieces.h"

namespace hybridrt {
namespace {

constexpr double kArea = 1.9;  // the head's area, to derive the size of triangles from their number
constexpr double kAir = 0.0015;

/// A point of a limb's spine, in the plane of symmetry, and the limb's half widths there: in that plane and across it.
struct Section {
  double x, y, in_plane, across;
};

Section operator+(const Section& a, const Section& b) {
  return {a.x + b.x, a.y + b.y, a.in_plane + b.in_plane, a.across + b.across};
}
Section operator*(double s, const Section& a) { return {s * a.x, s * a.y, s * a.in_plane, s * a.across}; }

/// A limb: elliptic sections along a smooth spine through its keys (Catmull-Rom).
class Limb {
 public:
  explicit Limb(std::initializer_list<Section> keys) : keys_(keys) {
    for (int i = 0; i <= kGuesses * last(); ++i) guesses_.push_back(at(static_cast<double>(i) / kGuesses, 0));
  }

  /// The section `t` keys along, or its first or second derivative.
  Section at(double t, int derivative) const {
    const int k = std::clamp(static_cast<int>(t), 0, last() - 1);
    const double w = t - k;
    const auto key = [&](int i) { return keys_[std::clamp(i, 0, last())]; };
    const Section a = key(k - 1), b = key(k), c = key(k + 1), d = key(k + 2);
    const Section linear = c + -1.0 * a, square = 2.0 * a + -5.0 * b + 4.0 * c + -1.0 * d,
                  cube = -1.0 * a + 3.0 * b + -3.0 * c + d;
    if (derivative == 2) return square + 3 * w * cube;
    if (derivative == 1) return 0.5 * linear + w * square + 1.5 * w * w * cube;
    return b + 0.5 * w * linear + 0.5 * w * w * square + 0.5 * w * w * w * cube;
  }

  double distance(const dvec3& p) const {
    // The nearest of the guesses, measured in widths; then on to the foot of the perpendicular.
    double nearest = 1e9, t = 0;
    for (size_t i = 0; i < guesses_.size(); ++i) {
      const Section& s = guesses_[i];
      const double dx = p.x - s.x, dy = p.y - s.y, off = (dx * dx + dy * dy) / (s.in_plane * s.in_plane);
      if (off < nearest) nearest = off, t = static_cast<double>(i) / kGuesses;
    }
    for (int i = 0; i < 3; ++i) {
      const Section s = at(t, 0), d = at(t, 1), dd = at(t, 2);
      const dvec2 off(s.x - p.x, s.y - p.y), slope(d.x, d.y);
      const double steep = glm::dot(slope, slope);
      const double curvature = std::max(steep + glm::dot(off, dvec2(dd.x, dd.y)), 0.3 * steep);
      t = std::clamp(t - glm::dot(off, slope) / curvature, 0.0, static_cast<double>(last()));
    }
    const Section s = at(t, 0);
    const double off = std::hypot(p.x - s.x, p.y - s.y) / s.in_plane, side = p.z / s.across;
    const double k0 = std::hypot(off, side), k1 = std::hypot(off / s.in_plane, side / s.across);
    return k1 > 1e-9 ? k0 * (k0 - 1) / k1 : -std::min(s.in_plane, s.across);
  }

 private:
  static constexpr int kGuesses = 4;
  int last() const { return static_cast<int>(keys_.size()) - 1; }

  std::vector<Section> keys_, guesses_;
};

/// The whole head as a solid.
struct Horse {
  // From the foot up to the poll, behind the ears.
  const Limb neck{{0.01, 0.24, 0.225, 0.215},   {-0.005, 0.40, 0.215, 0.185}, {-0.045, 0.56, 0.195, 0.150},
                  {-0.065, 0.72, 0.172, 0.122}, {-0.030, 0.87, 0.140, 0.104}, {0.030, 0.965, 0.095, 0.088}};
  // From the poll over the brow to the lips.
  const Limb head{{0.030, 0.955, 0.090, 0.088},
                  {0.100, 0.885, 0.105, 0.092},
                  {0.175, 0.800, 0.090, 0.076},
                  {0.245, 0.718, 0.071, 0.060},
                  {0.290, 0.665, 0.064, 0.057}};
  // The mane, from between the ears down the back of the neck.
  const Limb mane{{0.045, 1.035, 0.030, 0.026},  {-0.020, 1.030, 0.048, 0.050}, {-0.105, 0.965, 0.060, 0.064},
                  {-0.170, 0.860, 0.066, 0.072}, {-0.200, 0.730, 0.066, 0.078}, {-0.200, 0.590, 0.062, 0.082},
                  {-0.185, 0.450, 0.050, 0.080}, {-0.180, 0.350, 0.030, 0.060}};

  /// Cuts between the locks: wedges from outside the crest into it, lower outside, right across the neck.
  double mane_cuts(const dvec2& p) const {
    double distance = 1e9;
    for (int i = 0; i < 7; ++i) {
      const double t = 0.75 + 0.75 * i;
      const Section at = mane.at(t, 0), slope = mane.at(t, 1);
      const dvec2 down = glm::normalize(dvec2(slope.x, slope.y)), out(down.y, -down.x);
      const dvec2 middle(at.x, at.y), outside = middle + 0.085 * out + 0.030 * down;
      const dvec2 inside = middle - 0.012 * out - 0.035 * down;
      distance = std::min(distance, round_cone({p, 0}, {outside, 0}, {inside, 0}, 0.018, 0.006));
    }
    return distance;
  }

  /// The solid's function: that of the near half, mirrored.
  double operator()(const dvec3& point) const {
    const dvec3 p(point.x, point.y, std::abs(point.z));
    const dvec2 side(p.x, p.y);
    double d = neck.distance(p);
    d = smooth_union(d, ellipsoid(p, {0.085, 0.40, 0}, {0.165, 0.16, 0.155}), 0.10);  // chest
    // Skips what is too far away to matter.
    const bool near_head = p.y > 0.50;
    if (near_head) {
      double face = head.distance(p);
      face = smooth_union(face, ellipsoid(p, {0.062, 0.835, 0.030}, {0.098, 0.108, 0.078}), 0.020);  // jaw
      face = smooth_union(face, ellipsoid(p, {0.288, 0.690, 0.034}, {0.050, 0.042, 0.034}),
                          0.025);  // nostrils' wings
      d = smooth_union(d, face, 0.030);
    }
    if (p.x < 0.15) {
      const double locks = smooth_cut(mane.distance(p), mane_cuts(side), 0.026);
      d = smooth_union(d, locks, 0.014);
    }
    if (p.y > 0.85) {
      // Ears: leaves, hollow in front.
      double ear = round_cone(p, {0.000, 0.995, 0.056}, {0.012, 1.090, 0.070}, 0.046, 0.030);
      ear = smooth_union(ear, round_cone(p, {0.012, 1.080, 0.068}, {0.030, 1.165, 0.066}, 0.032, 0.006), 0.02);
      ear = smooth_cut(ear, round_cone(p, {0.058, 1.040, 0.078}, {0.052, 1.125, 0.078}, 0.030, 0.012), 0.012);
      d = smooth_union(d, ear, 0.018);
    }
    if (near_head) {
      // Brow, eye socket, eye.
      d = smooth_union(d, round_cone(p, {0.085, 0.950, 0.064}, {0.152, 0.902, 0.066}, 0.024, 0.014), 0.022);
      d = smooth_cut(d, ellipsoid(p, {0.128, 0.882, 0.100}, {0.042, 0.027, 0.024}), 0.016);
      d = smooth_union(d, ellipsoid(p, {0.124, 0.884, 0.078}, {0.023, 0.020, 0.017}), 0.006);
      // Nostril and mouth.
      d = smooth_cut(d, ellipsoid(p, {0.318, 0.700, 0.062}, {0.020, 0.013, 0.022}), 0.010);
      d = smooth_cut(d, round_cone({side, 0}, {0.350, 0.622, 0}, {0.232, 0.662, 0}, 0.015, 0.006), 0.012);
    }
    // Flat on the foot.
    const double below = kKnightFootHeight + kAir - p.y;
    return -smooth_union(-d, -below, 0.03);
  }
};

}  // namespace

TriangleMesh carve_knight(int64_t triangles) {
  constexpr double kTrianglesPerSquare = 4.4;  // per square of an edge's length
  const double edge = std::sqrt(kTrianglesPerSquare * kArea / static_cast<double>(std::max<int64_t>(triangles, 100)));
  return carve(Horse(), {-0.36, 0.24, -0.27}, {0.42, 1.16, 0.27}, edge);
}

}  // namespace hybridrt
