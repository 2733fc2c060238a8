// Where tracers are known to fail: each failure has its scene, and double precision or geometry gives the right answer.

#include <gtest/gtest.h>

#include "core/trace/embree_caster.h"
#include "core/trace/kd_caster.h"
#include "core/trace/light_buffer.h"
#include "core/trace/surface_at.h"
#include "tests/support/brute_force.h"
#include "tests/support/trace_scenes.h"

namespace hybridrt {
namespace {

/// Everything that answers shadow rays, built over one scene.
struct Backends {
  explicit Backends(const Scene& scene, const dvec3& toward)
      : tree(build_kd_tree(scene, pool)),
        kd(make_kd_caster(tree, LeafKernel::simd)),
        embree(make_embree_caster(scene, 1)),
        sheets(make_sheets(scene, build_topology(scene, pool), pool)),
        buffer(build_light_buffer(scene, sheets, toward, pool)) {}
  ThreadPool pool{1};
  KdTree tree;
  std::unique_ptr<RayCaster<float>> kd, embree;
  Sheets sheets;
  LightBuffer buffer;
};

// Wächter and Binder, Ray Tracing Gems, chapter 6: on the lit side of a convex body nothing is in the way, at any scale
// and distance from the origin. Points are the hits of rays in single precision, with all their rounding.
TEST(FailureModes, AConvexBodyDoesNotShadowItsLitSide) {
  const dvec3 toward = glm::normalize(dvec3(0.3, 0.9, -0.2));
  for (const float scale : {1e-4f, 1e-2f, 1.0f, 1e3f, 1e6f})
    for (const float offset_sizes : {0.0f, 10.0f, 1000.0f}) {
      Scene scene = transformed(closed_sphere(48, 24), scale, vec3(offset_sizes * scale));
      scene.normals = {vec3(0)};  // none: facets
      scene.triangle_normals.assign(scene.triangle_count(), uvec3(0));
      scene.triangle_materials.assign(scene.triangle_count(), 0);
      const Backends backends(scene, toward);
      const vec3 center = scene.bounds.center();
      Random random(3);
      std::vector<Ray<float>> seen, shadow;
      std::vector<ShadowQuery> queries;
      for (int i = 0; i < 3000; ++i) {
        const vec3 from = center + 3 * scale * random.direction();
        seen.push_back({from, glm::normalize(center + 0.7f * scale * random.in_cube(-1, 1) - from)});
      }
      std::vector<Hit<float>> hits(seen.size());
      backends.kd->closest_hits(seen, hits);
      for (size_t i = 0; i < hits.size(); ++i) {
        if (!hits[i].found()) continue;
        const Surface<float> surface = surface_at(scene, hits[i].triangle, hits[i].u, hits[i].v, seen[i].dir);
        // Facets that face away beside one that does not: a chord may leave the faceted ball and enter it again.
        if (!surface.from_outside || glm::dot(dvec3(surface.side), toward) < 0.02) continue;
        shadow.push_back(leave(surface, vec3(toward)));
        queries.push_back({dvec3(shadow.back().origin), hits[i].triangle});
      }
      ASSERT_GT(shadow.size(), 500u);
      std::vector<uint8_t> occluded(shadow.size());
      const auto count = [&] { return std::count(occluded.begin(), occluded.end(), uint8_t{1}); };
      backends.kd->any_hits(shadow, occluded);
      EXPECT_EQ(count(), 0) << "kd-tree " << scale << ' ' << offset_sizes;
      backends.embree->any_hits(shadow, occluded);
      EXPECT_EQ(count(), 0) << "Embree " << scale << ' ' << offset_sizes;
      shadow_answers(backends.buffer, queries, occluded);
      EXPECT_EQ(count(), 0) << "light buffer " << scale << ' ' << offset_sizes;
    }
}

// Needles a million times as long as wide, met at half a degree, half a unit from the start. Single precision cannot
// tell where along such a needle the ray meets it, nor quite whether: it must stay finite and be what brute force says.
// Double precision tells.
TEST(FailureModes, NeedlesAtGrazingAngles) {
  Random random(5);
  Scene scene;
  for (int i = 0; i < 300; ++i) {
    const vec3 a = random.in_cube(-1, 1), along = random.direction(), across = random.direction();
    add_triangle(scene, a, a + along, a + 0.5f * along + 1e-6f * across);
  }
  scene.bounds = compute_bounds(scene);
  const Backends backends(scene, {0, 1, 0});
  std::vector<Ray<float>> rays;
  for (int i = 0; i < 20000; ++i) {
    const uint32_t triangle = random.below(300);
    const vec3 a = scene.vertex(triangle, 0), b = scene.vertex(triangle, 1), c = scene.vertex(triangle, 2);
    const vec3 normal = glm::normalize(glm::cross(b - a, c - a)), along = glm::normalize(b - a);
    const vec3 dir = glm::normalize(along * std::cos(0.0087f) - normal * std::sin(0.0087f));  // half a degree
    const float u = random.between(0.3f, 0.6f), v = random.between(0.05f, 0.3f);
    rays.push_back({a + u * (b - a) + v * (c - a) - 0.5f * dir, dir});
  }
  const auto reference = make_reference_caster(backends.tree);
  std::vector<Hit<float>> kd(rays.size()), embree(rays.size());
  backends.kd->closest_hits(rays, kd);
  backends.embree->closest_hits(rays, embree);
  int found_in_double = 0;
  for (size_t i = 0; i < rays.size(); ++i) {
    const Ray<double> ray = in_double(rays[i]);
    Hit<double> truth;
    reference->closest_hits({&ray, 1}, {&truth, 1});
    if (truth.found() && std::abs(truth.t - 0.5) < 1e-4) ++found_in_double;
    for (const Hit<float>& hit : {kd[i], embree[i]})
      EXPECT_TRUE(!hit.found() || (hit.t >= 0 && std::isfinite(hit.t))) << i;
    if (i % 10 == 0) {
      EXPECT_EQ(kd[i].triangle, brute_force_hit(scene, rays[i]).triangle) << i;
    }
  }
  // The rays themselves are rounded to about a tenth of a needle's width.
  EXPECT_GT(found_in_double, static_cast<int>(rays.size() / 2));
}

// A box as wide as the solar system, with a small one on its floor.
TEST(FailureModes, HugeExtent) {
  Scene scene = transformed(closed_box(), 5.9e11f, vec3(0));
  const Scene small = transformed(closed_box(), 1e3f, vec3(1e5f, 1e5f, 1e5f));
  for (uint32_t i = 0; i < small.triangle_count(); ++i)
    add_triangle(scene, small.vertex(i, 0), small.vertex(i, 1), small.vertex(i, 2));
  scene.bounds = compute_bounds(scene);
  const Backends backends(scene, {0, 1, 0});
  const auto reference = make_reference_caster(backends.tree);
  Random random(6);
  std::vector<Ray<float>> rays;
  std::vector<Ray<double>> exact;
  for (int i = 0; i < 4000; ++i) {
    const vec3 from = i % 2 ? vec3(2e5f) + 1e5f * random.in_cube(-0.5f, 0.5f) : 5e11f * random.in_cube(0.2f, 1.0f);
    const vec3 target = i % 3 ? vec3(1e5f) + 1e3f * random.in_cube(0.1f, 0.9f) : 5.9e11f * random.in_cube(0.1f, 0.9f);
    rays.push_back({from, target - from});
    exact.push_back(in_double(rays.back()));
  }
  std::vector<Hit<float>> hits(rays.size()), embree(rays.size());
  std::vector<Hit<double>> truth(rays.size());
  backends.kd->closest_hits(rays, hits);
  backends.embree->closest_hits(rays, embree);
  reference->closest_hits(exact, truth);
  int small_box = 0;
  for (size_t i = 0; i < rays.size(); ++i) {
    ASSERT_TRUE(truth[i].found()) << "nothing leaves the big box";
    EXPECT_TRUE(hits[i].found() && embree[i].found()) << i;
    small_box += truth[i].triangle >= 12;
    if (i % 2) {  // from nearby, all see the small box alike
      EXPECT_EQ(hits[i].triangle >= 12, truth[i].triangle >= 12) << i;
    }
  }
  EXPECT_GT(small_box, 1000);
}

// Triangles of zero area and copies of triangles among the others change no answer.
TEST(FailureModes, DegenerateAndDoubledTrianglesChangeNothing) {
  const Scene clean = random_soup(11, 2000, 0.1f);
  Scene dirty = clean;
  Random random(12);
  for (int i = 0; i < 20; ++i) {
    const uint32_t of = random.below(2000);
    add_triangle(dirty, clean.vertex(of, 0), clean.vertex(of, 1), clean.vertex(of, 2));
    add_triangle(dirty, clean.vertex(of, 0), clean.vertex(of, 0), clean.vertex(of, 2));
    add_triangle(dirty, clean.vertex(of, 0), clean.vertex(of, 1), 0.5f * (clean.vertex(of, 0) + clean.vertex(of, 0)));
  }
  dirty.bounds = compute_bounds(dirty);
  const dvec3 toward = glm::normalize(dvec3(1, 2, 0.5));
  const Backends a(clean, toward), b(dirty, toward);
  const std::vector<Ray<float>> rays = assorted_rays(clean, 13, 20000);
  std::vector<Hit<float>> hits_a(rays.size()), hits_b(rays.size());
  a.kd->closest_hits(rays, hits_a);
  b.kd->closest_hits(rays, hits_b);
  for (size_t i = 0; i < rays.size(); ++i) {
    ASSERT_EQ(hits_a[i].triangle, hits_b[i].triangle) << i << ": the lower index wins";
    ASSERT_EQ(hits_a[i].t, hits_b[i].t);
  }
  std::vector<ShadowQuery> queries;
  for (const Ray<float>& ray : rays)
    if (all_finite(dvec3(ray.origin))) queries.push_back({dvec3(ray.origin), kNoTriangle, true, true});
  std::vector<uint8_t> occluded_a(queries.size()), occluded_b(queries.size());
  shadow_answers(a.buffer, queries, occluded_a);
  shadow_answers(b.buffer, queries, occluded_b);
  EXPECT_EQ(occluded_a, occluded_b);
}

}  // namespace
}  // namespace hybridrt
