#include "core/simplify/surface_distance.h"

#include <algorithm>
#include <atomic>
#include <cmath>

#include "core/base/check.h"
#include "core/trace/closest_point.h"

namespace hybridrt {
namespace {

constexpr int kFewestSteps = 3, kMostSteps = 256;  // of a grid along an edge
constexpr size_t kGrain = 1024;
constexpr double kRounding = 0x1p-22;  // times the scene's size

double area(const Scene& scene, uint32_t t) {
  const dvec3 a(scene.vertex(t, 0));
  return glm::length(glm::cross(dvec3(scene.vertex(t, 1)) - a, dvec3(scene.vertex(t, 2)) - a)) / 2;
}

/// The distance of neighbours in a grid that covers the surface with `area_samples`.
double spacing_for(const Scene& scene, double area_samples) {
  double total = 0;
  for (uint32_t t = 0; t < scene.triangle_count(); ++t) total += area(scene, t);
  return std::sqrt(total / area_samples);
}

/// Calls `take(point)` for the samples of a triangle, its middle first.
template <typename Take>
void for_each_sample(const Scene& scene, uint32_t t, double spacing, const Take& take) {
  const dvec3 a(scene.vertex(t, 0)), b(scene.vertex(t, 1)), c(scene.vertex(t, 2));
  const double longest = std::max({glm::length(b - a), glm::length(c - b), glm::length(a - c)});
  const double wanted = spacing > 0 ? std::min(std::ceil(longest / spacing), double{kMostSteps}) : 0;
  const int steps = std::max(kFewestSteps, static_cast<int>(wanted));
  take((a + b + c) / 3.0);
  for (int i = 0; i <= steps; ++i)
    for (int j = 0; i + j <= steps; ++j) {
      const double u = static_cast<double>(i) / steps, v = static_cast<double>(j) / steps;
      take((1 - u - v) * a + u * b + v * c);
    }
}

double size_of(const Aabb& box) {
  const vec3 extent = box.extent();
  return std::max({extent.x, extent.y, extent.z});
}

/// What the threads find; the result is a maximum, so their order does not matter.
struct Largest {
  double distance = 0, share = 0;
  size_t samples = 0;

  /// Whether the distance is beyond the bound.
  bool add(double found, double bound, double rounding) {
    ++samples;
    if (found <= rounding) return false;
    distance = std::max(distance, found);
    share = std::max(share, found / std::max(bound, rounding));
    return found > bound;
  }
  void add(const Largest& other) {
    distance = std::max(distance, other.distance), share = std::max(share, other.share), samples += other.samples;
  }
};

class Measurement {
 public:
  Measurement(const Scene& original, std::span<const float> bounds, const Scene& simplified, ThreadPool& pool,
              double area_samples)
      : original_(original), bounds_(bounds), simplified_(simplified), pool_(pool), area_samples_(area_samples) {
    HRT_CHECK_EQ(bounds.size(), original.triangle_count());
    HRT_CHECK(original.origin_world == simplified.origin_world);
    rounding_ = kRounding * size_of(original.bounds);
    likely_ = 16 * rounding_;
    for (float bound : bounds)
      if (std::isfinite(bound)) likely_ = std::max(likely_, double{bound});
  }

  SurfaceDistance measure() {
    SurfaceDistance result;
    result.exceeds.assign(original_.triangle_count(), 0);
    if (original_.triangle_count() == 0 || simplified_.triangle_count() == 0) return result;
    bad_ = std::vector<std::atomic<uint8_t>>(simplified_.triangle_count());
    exceeds_ = std::vector<std::atomic<uint8_t>>(original_.triangle_count());
    stands_for_.resize(original_.triangle_count());
    const Largest there = from_original(), back = from_simplified();
    for (size_t t = 0; t < exceeds_.size(); ++t) result.exceeds[t] = exceeds_[t] || bad_[stands_for_[t]];
    result.from_original = there.distance, result.from_simplified = back.distance;
    result.share = std::max(there.share, back.share);
    result.samples = there.samples + back.samples;
    return result;
  }

 private:
  template <typename Body>
  Largest over_triangles(const Scene& scene, const Body& body) {
    std::vector<Largest> found(static_cast<size_t>(pool_.size()));
    const size_t count = scene.triangle_count();
    pool_.run((count + kGrain - 1) / kGrain, [&](size_t chunk, int worker) {
      for (size_t t = chunk * kGrain; t < std::min(count, (chunk + 1) * kGrain); ++t)
        body(static_cast<uint32_t>(t), found[static_cast<size_t>(worker)]);
    });
    Largest all;
    for (const Largest& one : found) all.add(one);
    return all;
  }

  Largest from_original() {
    const ClosestPoints surface(simplified_, pool_.size());
    const double spacing = spacing_for(original_, area_samples_);
    return over_triangles(original_, [&](uint32_t t, Largest& largest) {
      bool first = true;
      for_each_sample(original_, t, spacing, [&](const dvec3& p) {
        const ClosestPoint at = surface.nearest(p, likely_);
        if (first) stands_for_[t] = at.triangle, first = false;
        if (largest.add(at.distance, bounds_[t], rounding_)) exceeds_[t] = bad_[at.triangle] = 1;
      });
    });
  }

  /// By triangle of the original: the largest bound at its vertices.
  std::vector<float> bounds_around() const {
    std::vector<float> at_vertex(original_.positions.size(), 0), around(original_.triangle_count());
    for (size_t t = 0; t < around.size(); ++t)
      for (int k = 0; k < 3; ++k) {
        float& bound = at_vertex[original_.triangle_positions[t][k]];
        bound = std::max(bound, bounds_[t]);
      }
    for (size_t t = 0; t < around.size(); ++t) {
      const uvec3& vertices = original_.triangle_positions[t];
      around[t] = std::max({at_vertex[vertices.x], at_vertex[vertices.y], at_vertex[vertices.z]});
    }
    return around;
  }

  Largest from_simplified() {
    const ClosestPoints surface(original_, pool_.size());
    const std::vector<float> around = bounds_around();
    const double spacing = spacing_for(simplified_, area_samples_);
    return over_triangles(simplified_, [&](uint32_t s, Largest& largest) {
      for_each_sample(simplified_, s, spacing, [&](const dvec3& p) {
        const ClosestPoint at = surface.nearest(p, likely_);
        if (largest.add(at.distance, around[at.triangle], rounding_)) bad_[s] = exceeds_[at.triangle] = 1;
      });
    });
  }

  const Scene& original_;
  const std::span<const float> bounds_;
  const Scene& simplified_;
  ThreadPool& pool_;
  const double area_samples_;
  double rounding_ = 0, likely_ = 0;
  std::vector<std::atomic<uint8_t>> bad_;      ///< by triangle of the simplified scene
  std::vector<std::atomic<uint8_t>> exceeds_;  ///< by triangle of the original
  std::vector<uint32_t> stands_for_;           ///< by triangle of the original: the one nearest to its middle
};

}  // namespace

SurfaceDistance measure_distance(const Scene& original, std::span<const float> bounds, const Scene& simplified,
                                 ThreadPool& pool, double area_samples) {
  return Measurement(original, bounds, simplified, pool, area_samples).measure();
}

}  // namespace hybridrt
