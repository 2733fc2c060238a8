#pragma once

#include <array>
#include <vector>

#include "core/scene/scene.h"

namespace hybridrt {

/// Triangles with the same three corners, by position (-0 = +0), in any order. Degenerate triangles are left out.
struct CoincidentTriangles {
  /// Ascending: those that no ray shows, as one with the same winding, a lower number and no holes wins each tie
  /// (NearestHit).
  std::vector<uint32_t> hidden;

  /// One of several that are not hidden.
  struct Tied {
    uint32_t triangle;
    std::array<vec3, 3> corners;
    uint32_t next;  ///< of those with the same corners, in `tied`; after the last the first
  };
  static constexpr uint32_t kAlone = ~0u;
  std::vector<Tied> tied;
  std::vector<uint32_t> tied_of;  ///< by triangle: its place in `tied`, or kAlone; empty if all are alone
};

CoincidentTriangles find_coincident(const Scene& scene);

/// Goes through ascending numbers, and tells the hidden ones.
class HiddenTriangles {
 public:
  explicit HiddenTriangles(const CoincidentTriangles& coincident)
      : at_(coincident.hidden.begin()), end_(coincident.hidden.end()) {}
  /// `triangle` must be higher than in the call before.
  bool holds(uint32_t triangle) {
    if (at_ == end_ || *at_ != triangle) return false;
    ++at_;
    return true;
  }

 private:
  std::vector<uint32_t>::const_iterator at_, end_;
};

/// A triangle at a point of it, as barycentric weights of its second and third corner.
struct TriangleAt {
  uint32_t triangle;
  float u, v;
};

/// Which of the triangles with the same corners as `met` a ray in direction `dir` shows there: of those without a hole
/// at that point one whose front it meets, then the lowest number. `met` is one of these.
/// `holes`: null if no triangle has any.
TriangleAt winner_of_tie(const CoincidentTriangles& coincident, const Textures* holes, const TriangleAt& met,
                         const vec3& dir);

}  // namespace hybridrt
