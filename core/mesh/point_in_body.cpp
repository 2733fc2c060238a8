#include "core/mesh/point_in_body.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace hybridrt {
namespace {

constexpr int kRays = 5, kMustAgree = 4;
constexpr double kOnSurface = 1e-6;  // of the body's size

// No axis and no diagonal, along which real meshes have edges.
constexpr std::array<dvec3, kRays> kDirections = {dvec3(0.4137, 0.8122, 0.4113), dvec3(-0.8719, 0.2351, 0.4297),
                                                  dvec3(0.2093, -0.4451, 0.8707), dvec3(-0.3371, -0.7239, -0.6019),
                                                  dvec3(0.7417, -0.1933, -0.6422)};

/// Coordinates in which rays go along z.
glm::dmat3 ray_from_scene(const dvec3& direction) {
  const dvec3 z = glm::normalize(direction), x = glm::normalize(glm::cross(dvec3(0, 1, 0), z));
  return glm::transpose(glm::dmat3(x, glm::cross(z, x), z));
}

/// Points in a grid across the rays.
class RayGrid {
 public:
  explicit RayGrid(std::span<const dvec3> points) : points_(points) {
    for (const dvec3& p : points) lo_ = glm::min(lo_, glm::dvec2(p)), hi_ = glm::max(hi_, glm::dvec2(p));
    side_ = std::clamp(static_cast<int>(std::sqrt(static_cast<double>(points.size()))), 1, 512);
    first_.assign(static_cast<size_t>(side_ * side_) + 2, 0);
    for (const dvec3& p : points) ++first_[cell_of(p) + 2];
    for (size_t i = 2; i < first_.size(); ++i) first_[i] += first_[i - 1];
    sorted_.resize(points.size());
    for (uint32_t i = 0; i < points.size(); ++i) sorted_[first_[cell_of(points[i]) + 1]++] = i;
  }

  /// Calls `body(point)` for the points in the cells that the box overlaps.
  template <typename Body>
  void for_each_in(const glm::dvec2& lo, const glm::dvec2& hi, const Body& body) const {
    if (lo.x > hi_.x || lo.y > hi_.y || hi.x < lo_.x || hi.y < lo_.y) return;
    const int end_x = column(hi.x), end_y = row(hi.y);
    for (int y = row(lo.y); y <= end_y; ++y)
      for (int x = column(lo.x); x <= end_x; ++x) {
        const auto cell = static_cast<size_t>(y * side_ + x);
        for (uint32_t i = first_[cell]; i < first_[cell + 1]; ++i) body(sorted_[i]);
      }
  }

 private:
  int step(double value, double lo, double hi) const {
    return hi > lo ? std::clamp(static_cast<int>(std::clamp((value - lo) / (hi - lo), 0.0, 1.0) * side_), 0, side_ - 1)
                   : 0;
  }
  int column(double x) const { return step(x, lo_.x, hi_.x); }
  int row(double y) const { return step(y, lo_.y, hi_.y); }
  size_t cell_of(const dvec3& p) const { return static_cast<size_t>(row(p.y) * side_ + column(p.x)); }

  std::span<const dvec3> points_;
  glm::dvec2 lo_{std::numeric_limits<double>::infinity()}, hi_{-std::numeric_limits<double>::infinity()};
  int side_ = 1;
  std::vector<uint32_t> first_, sorted_;
};

/// What the ray of a point has met.
struct Crossings {
  int turns = 0;  ///< leaving through a front face counts 1, through a back face -1
  bool at_edge = false, on_surface = false;
};

double cross(const glm::dvec2& a, const glm::dvec2& b) { return a.x * b.y - a.y * b.x; }

/// Counts the triangle if the ray of `p` along z meets it.
void cross_triangle(const dvec3& a, const dvec3& b, const dvec3& c, const dvec3& p, double on_surface,
                    Crossings& found) {
  const glm::dvec2 at(p);
  const double u = cross(glm::dvec2(c) - glm::dvec2(b), at - glm::dvec2(b)),
               v = cross(glm::dvec2(a) - glm::dvec2(c), at - glm::dvec2(c)),
               w = cross(glm::dvec2(b) - glm::dvec2(a), at - glm::dvec2(a));
  const bool some_left = u > 0 || v > 0 || w > 0, some_right = u < 0 || v < 0 || w < 0;
  if (some_left && some_right) return;
  if (u == 0 || v == 0 || w == 0) {
    found.at_edge = true;
    return;
  }
  const double z = (u * a.z + v * b.z + w * c.z) / (u + v + w);
  if (std::abs(z - p.z) <= on_surface) found.on_surface = true;
  if (z > p.z) found.turns += some_left ? 1 : -1;
}

}  // namespace

std::vector<Side> sides_of(std::span<const dvec3> points, const Scene& scene, std::span<const uint32_t> triangles) {
  Aabb box;
  for (const uint32_t t : triangles)
    for (int corner = 0; corner < 3; ++corner) box.grow(scene.vertex(t, corner));
  const double on_surface = kOnSurface * glm::length(box.extent());

  std::vector<int> inside(points.size()), outside(points.size());
  std::vector<bool> touches(points.size());
  std::vector<dvec3> turned(points.size());
  for (const dvec3& direction : kDirections) {
    const glm::dmat3 turn = ray_from_scene(direction);
    std::transform(points.begin(), points.end(), turned.begin(), [&](const dvec3& p) { return turn * p; });
    const RayGrid grid(turned);
    std::vector<Crossings> found(points.size());
    for (const uint32_t t : triangles) {
      const dvec3 a = turn * dvec3(scene.vertex(t, 0)), b = turn * dvec3(scene.vertex(t, 1)),
                  c = turn * dvec3(scene.vertex(t, 2));
      grid.for_each_in(glm::dvec2(glm::min(glm::min(a, b), c)), glm::dvec2(glm::max(glm::max(a, b), c)),
                       [&](uint32_t i) { cross_triangle(a, b, c, turned[i], on_surface, found[i]); });
    }
    for (size_t i = 0; i < points.size(); ++i) {
      if (found[i].on_surface) touches[i] = true;
      if (!found[i].at_edge) ++(found[i].turns != 0 ? inside : outside)[i];
    }
  }
  std::vector<Side> sides(points.size(), Side::unclear);
  for (size_t i = 0; i < points.size(); ++i)
    if (!touches[i] && std::max(inside[i], outside[i]) >= kMustAgree)
      sides[i] = inside[i] > outside[i] ? Side::inside : Side::outside;
  return sides;
}

}  // namespace hybridrt
