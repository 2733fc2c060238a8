#include "core/mesh/polygon.h"

#include <algorithm>
#include <array>

namespace hybridrt {
namespace {

/// How many steps to look for ears in a polygon of n corners before giving up: it must cross itself.
size_t most_steps_for(size_t n) { return 100'000 + std::min<size_t>(1000 * n, 100'000'000) + 50 * n; }

/// Twice the signed area of abc.
double cross2(dvec2 a, dvec2 b, dvec2 c) { return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x); }

dvec3 newell_normal(std::span<const dvec3> corners) {
  dvec3 normal(0);
  for (size_t i = 0; i < corners.size(); ++i)  // relative to one corner, to keep digits far from the origin
    normal += glm::cross(corners[i] - corners[0], corners[(i + 1) % corners.size()] - corners[0]);
  return normal;
}

/// The corners projected along an axis, counter-clockwise.
std::vector<dvec2> flattened(std::span<const dvec3> corners) {
  const dvec3 normal = newell_normal(corners);
  const dvec3 size = glm::abs(normal);
  const int drop = size.x > size.y && size.x > size.z ? 0 : size.y > size.z ? 1 : 2;
  int u = (drop + 1) % 3, v = (drop + 2) % 3;
  if (normal[drop] < 0) std::swap(u, v);
  std::vector<dvec2> flat(corners.size());
  for (size_t i = 0; i < corners.size(); ++i) flat[i] = {corners[i][u] - corners[0][u], corners[i][v] - corners[0][v]};
  return flat;
}

/// Corners that may lie inside an ear, sorted into the cells of a square grid.
class CornerGrid {
 public:
  CornerGrid(std::span<const dvec2> points, const std::vector<uint32_t>& members) {
    lo_ = dvec2(std::numeric_limits<double>::infinity());
    dvec2 hi(-lo_);
    for (const dvec2& p : points) lo_ = glm::min(lo_, p), hi = glm::max(hi, p);
    side_ = std::clamp<int>(static_cast<int>(std::sqrt(static_cast<double>(members.size()))), 1, 1024);
    for (int axis = 0; axis < 2; ++axis) scale_[axis] = hi[axis] > lo_[axis] ? side_ / (hi[axis] - lo_[axis]) : 0;
    starts_.assign(static_cast<size_t>(side_) * side_ + 1, 0);
    for (uint32_t member : members) ++starts_[cell(points[member]) + 1];
    for (size_t i = 1; i < starts_.size(); ++i) starts_[i] += starts_[i - 1];
    members_.resize(members.size());
    std::vector<uint32_t> next(starts_.begin(), starts_.end() - 1);
    for (uint32_t member : members) members_[next[cell(points[member])]++] = member;
  }

  /// Calls `visit(member)` for those in the cells that triangle abc touches, until one returns true. Counts `steps`.
  /// Goes row by row, as an ear may be a long sliver whose box holds everything.
  template <typename Visit>
  bool any(dvec2 a, dvec2 b, dvec2 c, size_t& steps, const Visit& visit) const {
    const std::array<dvec2, 4> corners = {in_cells(a), in_cells(b), in_cells(c), in_cells(a)};
    const auto [low, high] = std::minmax({corners[0].y, corners[1].y, corners[2].y});
    for (int row = clamped(low); row <= clamped(high); ++row) {
      double left = side_, right = 0;
      for (int edge = 0; edge < 3; ++edge) widen(corners[edge], corners[edge + 1], row, left, right);
      for (int x = clamped(left - kPad); x <= clamped(right + kPad); ++x) {
        ++steps;
        const size_t at = static_cast<size_t>(row) * side_ + x;
        for (uint32_t i = starts_[at]; i < starts_[at + 1]; ++i)
          if (++steps; visit(members_[i])) return true;
      }
    }
    return false;
  }

 private:
  static constexpr double kPad = 1e-6;  // cells; for rounding

  dvec2 in_cells(dvec2 p) const { return (p - lo_) * scale_; }
  int clamped(double cells) const { return std::clamp(static_cast<int>(cells), 0, side_ - 1); }
  size_t cell(dvec2 p) const {
    const dvec2 cells = in_cells(p);
    return static_cast<size_t>(clamped(cells.y)) * side_ + clamped(cells.x);
  }
  /// Grows [left, right] by the part of p-q that lies in the row. The last row includes its upper edge.
  void widen(dvec2 p, dvec2 q, int row, double& left, double& right) const {
    if (p.y > q.y) std::swap(p, q);
    const double bottom = row, top = row == side_ - 1 ? side_ + 1 : row + 1;
    if (q.y < bottom || p.y > top) return;
    const double slope = q.y > p.y ? (q.x - p.x) / (q.y - p.y) : 0;
    const double from = p.y < bottom ? p.x + (bottom - p.y) * slope : p.x;
    const double to = q.y > top ? p.x + (top - p.y) * slope : q.x;
    left = std::min({left, from, to}), right = std::max({right, from, to});
  }

  dvec2 lo_, scale_;
  int side_ = 1;
  std::vector<uint32_t> starts_, members_;
};

/// The remaining corners, as a ring.
struct Ring {
  std::vector<dvec2> points;
  std::vector<uint32_t> previous, next;
  std::vector<uint32_t> in_the_way;  ///< what kept a corner from being cut off when last tried; at first itself
  std::vector<char> convex, alive;   ///< convex: turns strictly left

  explicit Ring(std::vector<dvec2> flat) : points(std::move(flat)) {
    const auto n = static_cast<uint32_t>(points.size());
    previous.resize(n), next.resize(n), in_the_way.resize(n), convex.resize(n), alive.assign(n, 1);
    for (uint32_t i = 0; i < n; ++i) previous[i] = (i + n - 1) % n, next[i] = (i + 1) % n, in_the_way[i] = i;
    for (uint32_t i = 0; i < n; ++i) update(i);
  }
  uint32_t any_alive() const { return static_cast<uint32_t>(std::find(alive.begin(), alive.end(), 1) - alive.begin()); }
  double turn(uint32_t i) const { return cross2(points[previous[i]], points[i], points[next[i]]); }
  void update(uint32_t i) { convex[i] = turn(i) > 0; }
  void remove(uint32_t i) {
    alive[i] = 0;
    next[previous[i]] = next[i];
    previous[next[i]] = previous[i];
    update(previous[i]);
    update(next[i]);
  }
};

/// Whether corner `b` can be cut off: no other corner lies in its triangle. Only corners that were not convex at the
/// start can (and `grid` holds those); corners in the same place as one of the ear's do not count, as polygons with a
/// hole run twice along one edge.
bool is_ear(Ring& ring, const CornerGrid& grid, uint32_t b, size_t& steps) {
  if (!ring.convex[b]) return false;
  const uint32_t a = ring.previous[b], c = ring.next[b];
  const dvec2 pa = ring.points[a], pb = ring.points[b], pc = ring.points[c];
  const auto inside = [&](uint32_t other) {
    if (!ring.alive[other] || ring.convex[other] || other == a || other == b || other == c) return false;
    const dvec2 p = ring.points[other];
    if (p == pa || p == pb || p == pc) return false;
    return cross2(pa, pb, p) >= 0 && cross2(pb, pc, p) >= 0 && cross2(pc, pa, p) >= 0;
  };
  if (inside(ring.in_the_way[b])) return false;  // mostly the same as last time
  return !grid.any(pa, pb, pc, steps, [&](uint32_t other) {
    if (!inside(other)) return false;
    ring.in_the_way[b] = other;
    return true;
  });
}

std::vector<uint32_t> corners_that_are(bool convex, const Ring& ring) {
  std::vector<uint32_t> corners;
  for (uint32_t i = 0; i < ring.points.size(); ++i)
    if ((ring.convex[i] != 0) == convex) corners.push_back(i);
  return corners;
}

/// Cuts ears off in rounds over the convex corners. The neighbours of a corner that was cut off wait for the next
/// round, or a round polygon would become a fan of slivers.
class EarClipper {
 public:
  EarClipper(std::span<const dvec3> corners, std::vector<uvec3>& triangles)
      : ring_(flattened(corners)),
        grid_(ring_.points, corners_that_are(false, ring_)),
        triangles_(triangles),
        left_(corners.size()),
        candidates_(corners_that_are(true, ring_)),
        waits_in_(corners.size(), 0),
        queued_in_(corners.size(), 0) {}

  /// False if the polygon crosses itself, or takes too many steps.
  bool run() {
    const size_t most_steps = most_steps_for(ring_.points.size());
    bool clean = true;
    for (round_ = 1; left_ > 3 && steps_ < most_steps; ++round_) {
      const size_t before = left_;
      cut_ears();
      if (left_ == before) clean &= cut_without_ear();
      candidates_.swap(later_);
      later_.clear();
    }
    clean = clean && left_ == 3;
    for (uint32_t i = ring_.any_alive(); left_ >= 3; --left_, i = ring_.previous[i]) {
      triangles_.emplace_back(ring_.previous[i], i, ring_.next[i]);
      ring_.remove(i);
    }
    return clean;
  }

 private:
  void cut_ears() {
    for (const uint32_t i : candidates_) {
      if (left_ <= 3 || !ring_.alive[i] || waits_in_[i] == round_) continue;
      if (++steps_; is_ear(ring_, grid_, i, steps_))
        cut(i);
      else
        try_later(i);
    }
  }

  /// A straight corner may go. Without one the polygon crosses itself, and any corner goes: false.
  bool cut_without_ear() {
    uint32_t straight = 0;
    while (straight < ring_.points.size() && !(ring_.alive[straight] && ring_.turn(straight) == 0)) ++straight;
    const bool found = straight < ring_.points.size();
    cut(found ? straight : ring_.any_alive());
    steps_ += ring_.points.size();
    return found;
  }

  void try_later(uint32_t i) {
    if (!ring_.convex[i] || queued_in_[i] == round_) return;
    queued_in_[i] = round_;
    later_.push_back(i);
  }

  void cut(uint32_t i) {
    triangles_.emplace_back(ring_.previous[i], i, ring_.next[i]);
    ring_.remove(i);
    --left_;
    for (const uint32_t neighbour : {ring_.previous[i], ring_.next[i]}) {
      try_later(neighbour);
      waits_in_[neighbour] = round_;
    }
  }

  Ring ring_;
  const CornerGrid grid_;
  std::vector<uvec3>& triangles_;
  size_t steps_ = 0, left_;
  uint32_t round_ = 1;
  std::vector<uint32_t> candidates_, later_;
  std::vector<uint32_t> waits_in_, queued_in_;  ///< the round
};

bool clip_ears(std::span<const dvec3> corners, std::vector<uvec3>& triangles) {
  if (newell_normal(corners) != dvec3(0)) return EarClipper(corners, triangles).run();
  // All on one line, or a figure of eight.
  for (uint32_t i = 2; i < corners.size(); ++i) triangles.emplace_back(0, i - 1, i);
  return false;
}

/// How good the cut a-c is: a point for each of abc, acd that has an area, one if they face the same way. A triangle so
/// flat that float coordinates may make it vanish counts as having none: a quad with a straight corner has a better
/// cut.
int cut_score(const dvec3& a, const dvec3& b, const dvec3& c, const dvec3& d) {
  constexpr double kFlat = 1e-6;  // sine of the angle at a
  const dvec3 ab = b - a, ac = c - a, ad = d - a;
  const dvec3 abc = glm::cross(ab, ac), acd = glm::cross(ac, ad);
  const double length_ac = glm::length(ac);
  return (glm::length(abc) > kFlat * glm::length(ab) * length_ac) +
         (glm::length(acd) > kFlat * length_ac * glm::length(ad)) + (glm::dot(abc, acd) > 0);
}

void cut_quad(std::span<const dvec3> q, std::vector<uvec3>& triangles) {
  const int score02 = cut_score(q[0], q[1], q[2], q[3]), score13 = cut_score(q[1], q[2], q[3], q[0]);
  const dvec3 d02 = q[2] - q[0], d13 = q[3] - q[1];
  const bool shorter02 = glm::dot(d02, d02) <= glm::dot(d13, d13);
  if (score02 == score13 ? shorter02 : score02 > score13) {
    triangles.emplace_back(0, 1, 2);
    triangles.emplace_back(0, 2, 3);
  } else {
    triangles.emplace_back(0, 1, 3);
    triangles.emplace_back(1, 2, 3);
  }
}

}  // namespace

bool triangulate_polygon(std::span<const dvec3> corners, std::vector<uvec3>& triangles) {
  if (corners.size() == 3) {
    triangles.emplace_back(0, 1, 2);
    return true;
  }
  if (corners.size() == 4) {
    cut_quad(corners, triangles);
    return true;
  }
  return clip_ears(corners, triangles);
}

}  // namespace hybridrt
