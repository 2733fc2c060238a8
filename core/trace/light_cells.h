#pragma once

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <optional>

#include "core/trace/light_buffer.h"

namespace hybridrt {

// How a triangle lies over the cells of a light buffer: in double precision, in grid coordinates, where a
// cell is two units wide and the centre of cell (i, j) is (2 i + 1, 2 j + 1).

/// In a cell's coordinates single precision errs by less than this, with room to spare: every number is at most about
/// 3, and there are three operations. The uncertain zone around an edge is this wide.
inline constexpr double kCellError = 0x1p-21;

/// Triangles this close to a cell count as over it.
inline constexpr double kMargin = 2 * kCellError;

/// A point of the scene in light space, relative to the buffer's centre, z away from the light.
inline dvec3 light_from_scene(const LightBuffer& buffer, const dvec3& p) {
  const dvec3 d = p - buffer.center;
  return {glm::dot(d, buffer.x_axis), glm::dot(d, buffer.y_axis), -glm::dot(d, buffer.toward)};
}

/// From light space to grid coordinates; z is scaled to [-1, 1] over the scene.
inline dvec3 grid_from_light(const LightBuffer& buffer, const dvec3& p) {
  const double scale = 2 * buffer.cells_per_unit;
  return {(p.x - buffer.corner.x) * scale, (p.y - buffer.corner.y) * scale, p.z * buffer.depth_per_unit};
}

/// a x + b y + c: a multiple of the signed distance to an edge, positive inside. All zero for an edge that looks so
/// short from the light that rounding destroys its direction: it decides nothing.
struct GridEdge {
  double a = 0, b = 0, c = 0;
  double reach() const { return std::abs(a) + std::abs(b); }  ///< its change from a cell's centre to a corner, at most
};

struct GridTriangle {
  GridEdge edges[3];
  dvec3 lo{0}, hi{0};      ///< bounds
  bool has_plane = false;  ///< false if seen (nearly) edge-on; then only lo.z and hi.z bound the depth
  double slope_x = 0, slope_y = 0, depth = 0;  ///< z = slope_x x + slope_y y + depth

  static constexpr double kShortest = 1e-4;

  GridTriangle(const dvec3& p0, const dvec3& p1, const dvec3& p2)
      : lo(glm::min(glm::min(p0, p1), p2)), hi(glm::max(glm::max(p0, p1), p2)) {
    const dvec3 e1 = p1 - p0, e2 = p2 - p0;
    const double area = e1.x * e2.y - e1.y * e2.x;
    const double turn = area < 0 ? -1 : 1;
    const auto set_edge = [turn](GridEdge& edge, const dvec3& from, const dvec3& to) {
      edge.a = (from.y - to.y) * turn;
      edge.b = (to.x - from.x) * turn;
      if (edge.reach() < kShortest) edge = {};
      edge.c = -(edge.a * from.x + edge.b * from.y);
    };
    set_edge(edges[0], p0, p1);
    set_edge(edges[1], p1, p2);
    set_edge(edges[2], p2, p0);
    // Rounding also destroys the plane of a sliver.
    const double longest = std::max({std::abs(e1.x), std::abs(e1.y), std::abs(e2.x), std::abs(e2.y)});
    if (std::abs(area) <= 1e-5 * longest * longest) return;
    has_plane = true;
    const double per_area = 1 / area;
    slope_x = (e1.z * e2.y - e2.z * e1.y) * per_area;
    slope_y = (e2.z * e1.x - e1.z * e2.x) * per_area;
    depth = p0.z - slope_x * p0.x - slope_y * p0.y;
  }
};

/// The triangle over one cell.
class CellView {
 public:
  CellView(const GridTriangle& triangle, int i, int j) : triangle_(triangle), center_(2.0 * i + 1, 2.0 * j + 1) {
    const double x = center_.x, y = center_.y;
    for (int edge = 0; edge < 3; ++edge)
      distance_[edge] = triangle.edges[edge].a * x + triangle.edges[edge].b * y + triangle.edges[edge].c;
    lowest_ = triangle.lo.z, highest_ = triangle.hi.z;
    if (!triangle.has_plane) return;
    depth_ = triangle.slope_x * x + triangle.slope_y * y + triangle.depth;
    change_ = std::abs(triangle.slope_x) + std::abs(triangle.slope_y);
    const double reach = change_ * (1 + 2 * kMargin);  // for all that for_each_cell counts as over the cell
    lowest_ = std::max(lowest_, depth_ - reach - plane_error());
    highest_ = std::min(highest_, depth_ + reach + plane_error());
  }

  /// True if every point of the cell is certainly inside the edge.
  bool inside(int edge) const { return distance_[edge] > triangle_.edges[edge].reach() * (1 + 2 * kCellError); }
  bool covers() const { return inside(0) && inside(1) && inside(2); }

  /// True if the triangle certainly has a point in the cell: no line separates them. False for slivers, where rounding
  /// might decide.
  bool surely_touched() const {
    if (!triangle_.has_plane) return false;
    for (int edge = 0; edge < 3; ++edge)
      if (!(distance_[edge] + triangle_.edges[edge].reach() * (1 - kMargin) > 0)) return false;
    const dvec2 inner_lo = center_ - (1 - kMargin), inner_hi = center_ + (1 - kMargin);
    return triangle_.lo.x < inner_hi.x && triangle_.hi.x > inner_lo.x && triangle_.lo.y < inner_hi.y &&
           triangle_.hi.y > inner_lo.y;
  }

  /// Whether the centre of the cell lies in the triangle; nothing where rounding might decide.
  std::optional<bool> centered() const {
    const dvec2 lo = dvec2(triangle_.lo) - kMargin, hi = dvec2(triangle_.hi) + kMargin;
    if (center_.x < lo.x || center_.y < lo.y || center_.x > hi.x || center_.y > hi.y) return false;
    if (!triangle_.has_plane) return std::nullopt;
    bool within = true;
    for (int edge = 0; edge < 3; ++edge) {
      const double rounding = kCellError * triangle_.edges[edge].reach();
      if (distance_[edge] < -rounding) return false;
      within &= distance_[edge] > rounding;
    }
    return within ? std::optional(true) : std::nullopt;
  }

  /// Whether one of `sides` (bits) may cross the cell.
  bool crossed_by_sides(unsigned sides) const {
    for (int edge = 0; edge < 3; ++edge)
      if ((sides >> edge & 1) && std::abs(distance_[edge]) <= triangle_.edges[edge].reach() * (1 + 2 * kMargin))
        return true;
    return false;
  }

  /// Bounds of the depth over the cell, with room for the rounding of a query's depth.
  float nearest() const { return static_cast<float>(lowest_ - kDepthRoom); }
  float farthest() const { return static_cast<float>(highest_ + kDepthRoom); }

  /// `holes`: the triangle has some, which only double precision knows.
  LightEntry entry(uint32_t triangle, bool holes) const {
    LightEntry made{};
    made.triangle = triangle;
    for (int edge = 0; edge < 3; ++edge) {
      const double a = triangle_.edges[edge].a, b = triangle_.edges[edge].b;
      const double length = std::sqrt(a * a + b * b);
      const bool always = inside(edge);
      const double units = always || !(length > 0) ? 0 : 1 / (length * LightEntry::kUnit);
      made.a[edge] = rounded(a * units);
      made.b[edge] = rounded(b * units);
      made.c[edge] = rounded(always ? 1 / LightEntry::kUnit : distance_[edge] * units);
    }
    const double size = std::max(
        {std::abs(triangle_.slope_x), std::abs(triangle_.slope_y), std::abs(depth_ - nearest()) + kLowByteRoom});
    int exponent = 0;  // size <= 2^exponent
    std::frexp(size, &exponent);
    const bool known = triangle_.has_plane && plane_error() < 1 && exponent <= 20 && !holes;
    made.nearest = with_low_byte(nearest(), known ? static_cast<uint32_t>(128 + exponent) : 0xFFu);
    if (!known) return made;
    const double units = made.units_per_depth();
    made.a[3] = rounded(-triangle_.slope_x * units);
    made.b[3] = rounded(-triangle_.slope_y * units);
    made.c[3] = rounded((made.nearest - depth_) * units);
    return made;
  }

 private:
  static constexpr double kDepthRoom = 0x1p-21;
  static constexpr double kLowByteRoom = 0x1p-13;  // with_low_byte() goes down by less, as depths are at most 1

  /// Of a number of units; all that are kept lie within 2 / kUnit.
  static int16_t rounded(double units) {
    return static_cast<int16_t>(std::clamp(std::nearbyint(units), -32767.0, 32767.0));
  }

  /// The largest float up to `bound` with these lowest 8 bits; somewhat lower around zero.
  static float with_low_byte(float bound, uint32_t low) {
    if (std::abs(bound) < 0x1p-40f) bound = -0x1p-40f;
    const uint32_t bits = (std::bit_cast<uint32_t>(bound) & ~0xFFu) | low;
    if (std::bit_cast<float>(bits) <= bound) return std::bit_cast<float>(bits);
    return std::bit_cast<float>(bound > 0 ? bits - 0x100u : bits + 0x100u);
  }

  /// Bounds the error of a depth in the cell: the steeper the plane, the larger.
  double plane_error() const { return kCellError * (1 + change_ + std::abs(depth_)); }

  const GridTriangle& triangle_;
  const dvec2 center_;
  double distance_[3];
  double depth_ = 0;   ///< the plane's depth at the cell's centre
  double change_ = 0;  ///< its change from there to a corner, at most
  double lowest_, highest_;
};

/// Calls body(i, j) for every cell of the grid that the triangle may touch, row after row.
template <typename Body>
void for_each_cell(const GridTriangle& triangle, int cells_x, int cells_y, const Body& body) {
  constexpr int kWide = 4;
  const auto cell = [](double x, int cells) {
    return static_cast<int>(std::clamp(std::floor(0.5 * x), 0.0, cells - 1.0));
  };
  const int first_i = cell(triangle.lo.x - kMargin, cells_x), last_i = cell(triangle.hi.x + kMargin, cells_x);
  const int first_j = cell(triangle.lo.y - kMargin, cells_y), last_j = cell(triangle.hi.y + kMargin, cells_y);
  for (int j = first_j; j <= last_j; ++j) {
    double rest[3];  // distance of the cell's farthest corner to the edge, minus a x
    double from = triangle.lo.x, to = triangle.hi.x;
    for (int e = 0; e < 3; ++e) {
      const GridEdge& edge = triangle.edges[e];
      rest[e] = edge.b * (2.0 * j + 1) + edge.c + edge.reach() * (1 + kMargin);
      if (last_i - first_i < kWide) continue;
      if (edge.a > 1e-3 * std::abs(edge.b)) from = std::max(from, -rest[e] / edge.a);
      if (edge.a < -1e-3 * std::abs(edge.b)) to = std::min(to, -rest[e] / edge.a);
    }
    const int row_first = std::max(first_i, cell(from, cells_x) - 1),
              row_last = std::min(last_i, cell(to, cells_x) + 1);
    for (int i = row_first; i <= row_last; ++i) {
      const double x = 2.0 * i + 1;
      const bool touches = triangle.edges[0].a * x + rest[0] >= 0 && triangle.edges[1].a * x + rest[1] >= 0 &&
                           triangle.edges[2].a * x + rest[2] >= 0;
      if (touches) body(i, j);
    }
  }
}

}  // namespace hybridrt
