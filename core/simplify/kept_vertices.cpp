#include "core/simplify/kept_vertices.h"

#include <numeric>

#include "core/base/check.h"

namespace hybridrt {
namespace {

/// Union-find over corners (path halving; the smaller root stays).
class Joined {
 public:
  explicit Joined(size_t count) : parent_(count) { std::iota(parent_.begin(), parent_.end(), 0u); }
  uint32_t root(uint32_t i) {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }
  void join(uint32_t a, uint32_t b) {
    a = root(a), b = root(b);
    if (a != b) parent_[std::max(a, b)] = std::min(a, b);
  }

 private:
  std::vector<uint32_t> parent_;
};

class Finder {
 public:
  Finder(const Scene& scene, const Topology& topology, std::span<const uint32_t> welded, std::span<const float> bounds)
      : scene_(scene), topology_(topology), welded_(welded), bounds_(bounds) {
    HRT_CHECK_EQ(bounds.size(), scene.triangle_count());
    HRT_CHECK_EQ(welded.size(), scene.positions.size());
  }

  Fans find() {
    find_triangles_left_alone();
    join_corners();
    keep_special_points();
    keep_edges();
    for (uint32_t t = 0; t < scene_.triangle_count(); ++t)
      if (!(bounds_[t] > 0)) keep_triangle(t);
    fans_.kept.reserve(fans_.vertex_of_fan.size());
    for (uint32_t vertex : fans_.vertex_of_fan) fans_.kept.push_back(kept_[vertex]);
    return std::move(fans_);
  }

 private:
  uint32_t vertex_at(Corner corner) const {
    return welded_[scene_.triangle_positions[corner / 3][static_cast<int>(corner % 3)]];
  }
  Corner corner_at(uint32_t triangle, uint32_t vertex) const {
    for (Corner corner = 3 * triangle;; ++corner) {
      HRT_CHECK(corner < 3 * triangle + 3);
      if (vertex_at(corner) == vertex) return corner;
    }
  }
  void keep_triangle(uint32_t t) {
    for (Corner corner = 3 * t; corner < 3 * t + 3; ++corner) kept_[vertex_at(corner)] = 1;
  }

  void find_triangles_left_alone() {
    std::vector<uint32_t> used_edges(scene_.triangle_count(), 0);
    left_alone_.assign(scene_.triangle_count(), 0);
    for (size_t e = 0; e < topology_.edges.size(); ++e) {
      const EdgeKind kind = topology_.kind_of(e);
      for (const EdgeUse& use : topology_.uses_of(e)) {
        ++used_edges[use.triangle];
        if (kind == EdgeKind::non_manifold || kind == EdgeKind::inconsistent) left_alone_[use.triangle] = 1;
      }
    }
    for (size_t t = 0; t < used_edges.size(); ++t)
      if (used_edges[t] < 3) left_alone_[t] = 1;  // degenerate
  }

  /// The two triangles of an edge inside the surface that may change, or false.
  bool inner_edge(size_t edge, uint32_t& t, uint32_t& u) const {
    if (topology_.kind_of(edge) != EdgeKind::regular) return false;
    t = topology_.uses_of(edge)[0].triangle, u = topology_.uses_of(edge)[1].triangle;
    return !left_alone_[t] && !left_alone_[u];
  }

  void join_corners() {
    const auto corners = static_cast<uint32_t>(3 * scene_.triangle_count());
    Joined joined(corners);
    uint32_t t, u;
    for (size_t e = 0; e < topology_.edges.size(); ++e) {
      if (!inner_edge(e, t, u)) continue;
      for (uint32_t vertex : {topology_.edges[e].a, topology_.edges[e].b})
        joined.join(corner_at(t, vertex), corner_at(u, vertex));
    }
    fans_.fan_of_corner.assign(corners, kNoFan);
    for (Corner corner = 0; corner < corners; ++corner) {
      if (left_alone_[corner / 3]) continue;
      const Corner root = joined.root(corner);
      if (root == corner) {
        fans_.fan_of_corner[corner] = static_cast<uint32_t>(fans_.vertex_of_fan.size());
        fans_.vertex_of_fan.push_back(vertex_at(corner));
      } else {
        fans_.fan_of_corner[corner] = fans_.fan_of_corner[root];
      }
    }
  }

  void keep_special_points() {
    std::vector<uint8_t> special(scene_.positions.size(), 0), seen(special);
    for (uint32_t vertex : fans_.vertex_of_fan) {
      if (seen[vertex]) special[vertex] = 1;
      seen[vertex] = 1;
    }
    for (Corner corner = 0; corner < fans_.fan_of_corner.size(); ++corner)
      if (left_alone_[corner / 3]) special[vertex_at(corner)] = 1;
    kept_ = special;
    for (const Edge& edge : topology_.edges)
      if (special[edge.a] || special[edge.b]) kept_[edge.a] = kept_[edge.b] = 1;
  }

  dvec3 unit_normal(uint32_t t) const {
    const dvec3 a(scene_.vertex(t, 0));
    const dvec3 normal = glm::cross(dvec3(scene_.vertex(t, 1)) - a, dvec3(scene_.vertex(t, 2)) - a);
    const double length = glm::length(normal);
    return length > 0 ? normal / length : dvec3(0);
  }

  void keep_edges() {
    const double least_cosine = std::cos(kCreaseAngle_deg * kPi / 180);
    uint32_t t, u;
    for (size_t e = 0; e < topology_.edges.size(); ++e) {
      const auto [a, b] = topology_.edges[e];
      const bool smooth = inner_edge(e, t, u) && shade_alike(scene_, corner_at(t, a), corner_at(u, a)) &&
                          shade_alike(scene_, corner_at(t, b), corner_at(u, b)) &&
                          glm::dot(unit_normal(t), unit_normal(u)) >= least_cosine;
      if (!smooth) kept_[a] = kept_[b] = 1;
    }
  }

  const Scene& scene_;
  const Topology& topology_;
  const std::span<const uint32_t> welded_;
  const std::span<const float> bounds_;
  std::vector<uint8_t> left_alone_;  ///< by triangle
  std::vector<uint8_t> kept_;        ///< by welded index
  Fans fans_;
};

}  // namespace

Fans find_fans(const Scene& scene, const Topology& topology, std::span<const uint32_t> welded,
               std::span<const float> bounds) {
  return Finder(scene, topology, welded, bounds).find();
}

}  // namespace hybridrt
