// No ray leaves a closed body in double precision, tested with ten million rays.

#include <atomic>
#include <cstdlib>
#include <gtest/gtest.h>

#include "core/procedural/chess.h"
#include "core/trace/kd_caster.h"
#include "tests/support/closed_mesh.h"
#include "tests/support/trace_scenes.h"

namespace hybridrt {
namespace {

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__) || !defined(NDEBUG)
constexpr int kProofRays = 1'000'000;  // ten times slower
#else
constexpr int kProofRays = 10'000'000;
#endif

/// How often the scene's surface winds around a point: the solid angles of its triangles (van Oosterom and
/// Strackee 1983), summed up.
double winding_number(const Scene& scene, const dvec3& point) {
  double sum = 0;
  for (uint32_t t = 0; t < scene.triangle_count(); ++t) {
    const dvec3 a = dvec3(scene.vertex(t, 0)) - point, b = dvec3(scene.vertex(t, 1)) - point,
                c = dvec3(scene.vertex(t, 2)) - point;
    const double la = glm::length(a), lb = glm::length(b), lc = glm::length(c);
    sum += 2 * std::atan2(glm::dot(a, glm::cross(b, c)),
                          la * lb * lc + glm::dot(a, b) * lc + glm::dot(b, c) * la + glm::dot(c, a) * lb);
  }
  return sum / (4 * kPi);
}

/// A point inside a closed body, and the triangles of that body.
struct Inside {
  dvec3 point;
  uint32_t body;  ///< as components_of names it
  std::vector<uint32_t> triangles;
};

/// Points under random triangles.
std::vector<Inside> points_inside(const Scene& scene, const std::vector<uint32_t>& body_of, int count) {
  Random random(23);
  std::vector<Inside> found;
  for (int tries = 0; static_cast<int>(found.size()) < count && tries < 20 * count; ++tries) {
    const uint32_t t = random.below(static_cast<uint32_t>(scene.triangle_count()));
    const dvec3 a(scene.vertex(t, 0)), b(scene.vertex(t, 1)), c(scene.vertex(t, 2));
    const dvec3 normal = glm::cross(b - a, c - a), middle = (a + b + c) / 3.0;
    Inside inside{middle - 0.2 / std::sqrt(glm::length(normal)) * normal, body_of[scene.triangle_positions[t].x], {}};
    Scene body;
    body.positions = scene.positions;
    for (uint32_t other = 0; other < scene.triangle_count(); ++other)
      if (body_of[scene.triangle_positions[other].x] == inside.body) {
        inside.triangles.push_back(other);
        body.triangle_positions.push_back(scene.triangle_positions[other]);
      }
    if (std::abs(winding_number(body, inside.point) - 1) < 1e-6) found.push_back(std::move(inside));
  }
  return found;
}

/// Traces rays from inside a body to its exact vertices, and to points of its edges as exact as double allows; returns
/// how many meet nothing, or another body, before they meet their own.
int64_t count_leaks(const Scene& scene, int64_t count, ThreadPool& pool) {
  constexpr int64_t kBatch = 10000;
  const std::vector<uint32_t> body_of = components_of(scene);
  const std::vector<Inside> places = points_inside(scene, body_of, 40);
  EXPECT_EQ(places.size(), 40u);
  const KdTree tree = build_kd_tree(scene, pool);
  const auto caster = make_reference_caster(tree);
  std::atomic<int64_t> leaks = 0;
  pool.run(static_cast<size_t>((count + kBatch - 1) / kBatch), [&](size_t batch, int) {
    Random random(static_cast<uint32_t>(batch) + 1);
    std::vector<Ray<double>> rays;
    std::vector<uint32_t> bodies;
    for (int64_t i = 0; i < kBatch; ++i) {
      const Inside& from = places[random.below(static_cast<uint32_t>(places.size()))];
      const uint32_t t = from.triangles[random.below(static_cast<uint32_t>(from.triangles.size()))];
      const int corner = static_cast<int>(random.below(3));
      const dvec3 a(scene.vertex(t, corner)), b(scene.vertex(t, (corner + 1) % 3));
      const double along = random.below(3) ? double(random.unit()) : 0.5 * random.below(2);
      rays.push_back({from.point, a + along * (b - a) - from.point});
      bodies.push_back(from.body);
    }
    std::vector<Hit<double>> hits(kBatch);
    caster->closest_hits(rays, hits);
    for (size_t i = 0; i < rays.size(); ++i)
      leaks += !hits[i].found() || body_of[scene.triangle_positions[hits[i].triangle].x] != bodies[i];
  });
  return leaks;
}

// Ten million rays in double at exact edges and vertices of closed bodies: none gets through. For more,
// HYBRIDRT_PROOF_RAYS=100000000 build/release/bin/unit_tests --gtest_filter=Watertight.NoneOfTenMillionRaysLeavesABody
TEST(Watertight, NoneOfTenMillionRaysLeavesABody) {
  const char* more = std::getenv("HYBRIDRT_PROOF_RAYS");
  const int64_t count = more ? std::atoll(more) : kProofRays;
  ThreadPool pool(2);
  for (const Scene& scene : {closed_box(), closed_sphere(64, 32), make_chess({10'000, {}})})
    EXPECT_EQ(count_leaks(scene, count / 3 + 1, pool), 0) << scene.triangle_count() << " triangles";
}

}  // namespace
}  // namespace hybridrt
