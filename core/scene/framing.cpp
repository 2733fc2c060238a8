#include "core/scene/framing.h"

#include <algorithm>
#include <numeric>
#include <vector>

namespace hybridrt {
namespace {

constexpr double kMostOfTriangles = 0.01, kMostOfArea = 0.01, kLarger = 4;
constexpr size_t kAlwaysAFew = 4;

struct Piece {
  double area = 0;
  dvec3 middle{0};
};

Piece piece(const Scene& scene, uint32_t triangle) {
  const dvec3 a(scene.vertex(triangle, 0)), b(scene.vertex(triangle, 1)), c(scene.vertex(triangle, 2));
  return {0.5 * glm::length(glm::cross(b - a, c - a)), (a + b + c) / 3.0};
}

double median_along(int axis, std::vector<Piece>& pieces, double area) {
  std::sort(pieces.begin(), pieces.end(),
            [axis](const Piece& a, const Piece& b) { return a.middle[axis] < b.middle[axis]; });
  double below = 0;
  for (const Piece& p : pieces)
    if ((below += p.area) >= 0.5 * area) return p.middle[axis];
  return pieces.back().middle[axis];
}

/// The median, by area, of where triangles are: a few far away do not move it. Of a sample, which is enough.
dvec3 robust_middle(const Scene& scene) {
  constexpr size_t kSample = 20'000;
  const size_t step = 1 + scene.triangle_count() / kSample;
  std::vector<Piece> pieces;
  for (size_t i = 0; i < scene.triangle_count(); i += step) pieces.push_back(piece(scene, static_cast<uint32_t>(i)));
  const double area =
      std::accumulate(pieces.begin(), pieces.end(), 0.0, [](double sum, const Piece& p) { return sum + p.area; });
  return {median_along(0, pieces, area), median_along(1, pieces, area), median_along(2, pieces, area)};
}

struct Far {
  double distance;
  uint32_t triangle;
};

double distance_of(const Scene& scene, uint32_t triangle, const dvec3& middle) {
  double distance = 0;
  for (int k = 0; k < 3; ++k) distance = std::max(distance, glm::length(dvec3(scene.vertex(triangle, k)) - middle));
  return distance;
}

/// The triangles that may be stray, farthest first, and then the first that may not.
std::vector<Far> farthest_triangles(const Scene& scene, const dvec3& middle) {
  const size_t count = scene.triangle_count();
  const size_t most = std::max(static_cast<size_t>(kMostOfTriangles * static_cast<double>(count)), kAlwaysAFew);
  std::vector<Far> all(count);
  for (uint32_t i = 0; i < count; ++i) all[i] = {distance_of(scene, i, middle), i};
  const auto farther = [](const Far& a, const Far& b) {
    return a.distance != b.distance ? a.distance > b.distance : a.triangle < b.triangle;
  };
  const size_t kept = std::min(count, most + 1);
  std::partial_sort(all.begin(), all.begin() + static_cast<std::ptrdiff_t>(kept), all.end(), farther);
  all.resize(kept);
  return all;
}

/// How many of `farthest` are stray: those before each place where what is left is a quarter as large or less.
size_t count_stray(const Scene& scene, const std::vector<Far>& farthest) {
  double all_area = 0, far_area = 0;
  for (uint32_t i = 0; i < scene.triangle_count(); ++i) all_area += piece(scene, i).area;
  size_t stray = 0;
  for (size_t i = 1; i < farthest.size(); ++i) {
    far_area += piece(scene, farthest[i - 1].triangle).area;
    if (far_area >= kMostOfArea * all_area) break;
    if (farthest[i].distance > 0 && farthest[i].distance * kLarger <= farthest[stray].distance) stray = i;
  }
  return stray;
}

}  // namespace

Framing frame_scene(const Scene& scene) {
  Framing framing;
  framing.bounds = scene.bounds;
  if (scene.triangle_count() <= kAlwaysAFew) return framing;
  const std::vector<Far> farthest = farthest_triangles(scene, robust_middle(scene));
  framing.left_out = count_stray(scene, farthest);
  if (framing.left_out == 0) return framing;
  framing.an_outlier = scene.vertex(farthest[0].triangle, 0);

  std::vector<uint32_t> stray;
  for (size_t i = 0; i < framing.left_out; ++i) stray.push_back(farthest[i].triangle);
  std::sort(stray.begin(), stray.end());
  framing.bounds = Aabb();
  for (uint32_t i = 0; i < scene.triangle_count(); ++i)
    if (!std::binary_search(stray.begin(), stray.end(), i))
      for (int k = 0; k < 3; ++k) framing.bounds.grow(scene.vertex(i, k));
  return framing;
}

}  // namespace hybridrt
