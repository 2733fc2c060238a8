#include "core/passes/misplaced_triangles.h"

#include <algorithm>

namespace hybridrt {
namespace {

constexpr double kNoticeable_px = 0.25;  // less is repaired along edges

double distance_to_segment(const dvec3& a, const dvec3& b) {
  const dvec3 ab = b - a;
  const double squared = glm::dot(ab, ab);
  const double t = squared > 0 ? std::clamp(-glm::dot(a, ab) / squared, 0.0, 1.0) : 0;
  return glm::length(a + t * ab);
}

/// The distance from the origin to the triangle abc.
double distance_to_triangle(const dvec3& a, const dvec3& b, const dvec3& c) {
  const dvec3 normal = glm::cross(b - a, c - a);
  const double length = glm::length(normal);
  const auto inside = [&](const dvec3& p, const dvec3& q) { return glm::dot(glm::cross(p, q), normal) >= 0; };
  if (length > 0 && inside(a, b) && inside(b, c) && inside(c, a)) return std::abs(glm::dot(a, normal)) / length;
  return std::min({distance_to_segment(a, b), distance_to_segment(b, c), distance_to_segment(c, a)});
}

/// How many times farther than its nearest point a misplaced triangle's farthest corner is.
double least_reach(const View& view) { return kNoticeable_px * pixel_angle(view) / kCornerError; }

}  // namespace

bool may_be_misplaced(const Scene& scene, const View& view, double distance) {
  return distance * least_reach(view) < distance + glm::length(dvec3(scene.bounds.extent()));
}

std::vector<uint32_t> misplaced_triangles(const Scene& scene, const View& view) {
  const double reach = least_reach(view);
  std::vector<uint32_t> found;
  for (uint32_t i = 0; i < scene.triangle_count(); ++i) {
    const dvec3 corners[] = {dvec3(scene.vertex(i, 0)) - view.eye, dvec3(scene.vertex(i, 1)) - view.eye,
                             dvec3(scene.vertex(i, 2)) - view.eye};
    const double distances[] = {glm::length(corners[0]), glm::length(corners[1]), glm::length(corners[2])};
    const double farthest = std::max({distances[0], distances[1], distances[2]});
    const double longest = glm::length(corners[1] - corners[0]) + glm::length(corners[2] - corners[0]);
    if ((farthest - longest) * reach > farthest) continue;  // no part of it is near enough
    if (distance_to_triangle(corners[0], corners[1], corners[2]) * reach < farthest) found.push_back(i);
  }
  return found;
}

}  // namespace hybridrt
