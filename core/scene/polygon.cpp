#include "core/scene/polygon.h"

#include <algorithm>

namespace hybridrt {
namespace {

constexpr size_t kStepsPerCorner = 1000;

/// Twice the signed area of abc.
double cross2(dvec2 a, dvec2 b, dvec2 c) { return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x); }

dvec3 newell_normal(std::span<const dvec3> corners) {
  dvec3 normal(0);
  for (size_t i = 0; i < corners.size(); ++i)  // relative to one corner, or far polygons lose their digits
    normal += glm::cross(corners[i] - corners[0], corners[(i + 1) % corners.size()] - corners[0]);
  return normal;
}

/// Corners on the plane of two axes, counter-clockwise.
std::vector<dvec2> flattened(std::span<const dvec3> corners) {
  const dvec3 normal = newell_normal(corners);
  const dvec3 size = glm::abs(normal);
  const int drop = size.x > size.y && size.x > size.z ? 0 : size.y > size.z ? 1 : 2;
  int u = (drop + 1) % 3, v = (drop + 2) % 3;
  if (normal[drop] < 0) std::swap(u, v);
  std::vector<dvec2> flat(corners.size());
  for (size_t i = 0; i < corners.size(); ++i)
    flat[i] = {corners[i][u] - corners[0][u], corners[i][v] - corners[0][v]};
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
    for (int axis = 0; axis < 2; ++axis)
      scale_[axis] = hi[axis] > lo_[axis] ? side_ / (hi[axis] - lo_[axis]) : 0;
    starts_.assign(static_cast<size_t>(side_) * side_ + 1, 0);
    for (uint32_t member : members) ++starts_[cell(points[member]) + 1];
    for (size_t i = 1; i < starts_.size(); ++i) starts_[i] += starts_[i - 1];
    members_.resize(members.size());
    std::vector<uint32_t> next(starts_.begin(), starts_.end() - 1);
    for (uint32_t member : members) members_[next[cell(points[member])]++] = member;
  }

  /// `visit(member)` for those in the cells that the box touches, until one returns true. Counts `steps`.
  template <typename Visit>
  bool any(dvec2 lo, dvec2 hi, size_t& steps, const Visit& visit) const {
    for (int y = coordinate(lo, 1); y <= coordinate(hi, 1); ++y)
      for (int x = coordinate(lo, 0); x <= coordinate(hi, 0); ++x) {
        ++steps;
        const size_t at = static_cast<size_t>(y) * side_ + x;
        for (uint32_t i = starts_[at]; i < starts_[at + 1]; ++i)
          if (++steps; visit(members_[i])) return true;
      }
    return false;
  }

 private:
  int coordinate(dvec2 p, int axis) const {
    return std::clamp(static_cast<int>((p[axis] - lo_[axis]) * scale_[axis]), 0, side_ - 1);
  }
  size_t cell(dvec2 p) const { return static_cast<size_t>(coordinate(p, 1)) * side_ + coordinate(p, 0); }

  dvec2 lo_, scale_;
  int side_ = 1;
  std::vector<uint32_t> starts_, members_;
};

/// The corners that are left, as a ring.
struct Ring {
  std::vector<dvec2> points;
  std::vector<uint32_t> previous, next;
  std::vector<char> convex, alive;  ///< convex: turns strictly left

  explicit Ring(std::vector<dvec2> flat) : points(std::move(flat)) {
    const auto n = static_cast<uint32_t>(points.size());
    previous.resize(n), next.resize(n), convex.resize(n), alive.assign(n, 1);
    for (uint32_t i = 0; i < n; ++i) previous[i] = (i + n - 1) % n, next[i] = (i + 1) % n;
    for (uint32_t i = 0; i < n; ++i) update(i);
  }
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

/// Whether corner `b` can be cut off: no other corner lies in its triangle. Only corners that were not
/// convex at the start can (and `grid` holds those); corners in the same place as one of the ear's do not
/// count, as polygons with a hole run along the same edge twice.
bool is_ear(const Ring& ring, const CornerGrid& grid, uint32_t b, size_t& steps) {
  if (!ring.convex[b]) return false;
  const uint32_t a = ring.previous[b], c = ring.next[b];
  const dvec2 pa = ring.points[a], pb = ring.points[b], pc = ring.points[c];
  const auto inside = [&](uint32_t other) {
    if (!ring.alive[other] || ring.convex[other] || other == a || other == b || other == c) return false;
    const dvec2 p = ring.points[other];
    if (p == pa || p == pb || p == pc) return false;
    return cross2(pa, pb, p) >= 0 && cross2(pb, pc, p) >= 0 && cross2(pc, pa, p) >= 0;
  };
  return !grid.any(glm::min(pa, glm::min(pb, pc)), glm::max(pa, glm::max(pb, pc)), steps, inside);
}

bool clip_ears(std::span<const dvec3> corners, std::vector<uvec3>& triangles) {
  Ring ring(flattened(corners));
  std::vector<uint32_t> hollow;
  for (uint32_t i = 0; i < corners.size(); ++i)
    if (!ring.convex[i]) hollow.push_back(i);
  const CornerGrid grid(ring.points, hollow);

  const size_t most_steps = kStepsPerCorner * corners.size();
  size_t steps = 0, left = corners.size(), misses = 0;
  bool clean = true;
  for (uint32_t i = 0; left > 3; ++steps) {
    // After a whole round without an ear only straight corners can go; after another one, anything.
    const bool straight = misses > left && ring.turn(i) == 0;
    const bool forced = misses > 2 * left || steps > most_steps;
    if (!straight && !forced && !is_ear(ring, grid, i, steps)) {
      i = ring.next[i];
      ++misses;
      continue;
    }
    clean = clean && (straight || !forced);
    triangles.emplace_back(ring.previous[i], i, ring.next[i]);
    ring.remove(i);
    // Two on, not one: else a round polygon becomes a fan of slivers.
    i = ring.next[ring.next[i]];
    --left, misses = 0;
  }
  uint32_t i = 0;
  while (!ring.alive[i]) ++i;
  triangles.emplace_back(ring.previous[i], i, ring.next[i]);
  return clean;
}

/// Whether the cut a-c gives two triangles abc, acd that face the same way. One so flat that float
/// coordinates may make it vanish does not count: a quad with a straight corner has a better cut.
bool good_cut(const dvec3& a, const dvec3& b, const dvec3& c, const dvec3& d) {
  constexpr double kFlat = 1e-6;  // sine of the angle at a
  const dvec3 ab = b - a, ac = c - a, ad = d - a;
  const dvec3 abc = glm::cross(ab, ac), acd = glm::cross(ac, ad);
  const double length_ac = glm::length(ac);
  return glm::dot(abc, acd) > 0 && glm::length(abc) > kFlat * glm::length(ab) * length_ac &&
         glm::length(acd) > kFlat * length_ac * glm::length(ad);
}

void cut_quad(std::span<const dvec3> q, std::vector<uvec3>& triangles) {
  const bool good02 = good_cut(q[0], q[1], q[2], q[3]), good13 = good_cut(q[1], q[2], q[3], q[0]);
  const dvec3 d02 = q[2] - q[0], d13 = q[3] - q[1];
  const bool shorter02 = glm::dot(d02, d02) <= glm::dot(d13, d13);
  if (good02 == good13 ? shorter02 : good02) {
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
