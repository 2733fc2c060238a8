// Triangles on one another: which is shown, by every structure, against brute force.

#include "core/trace/coincident.h"

#include <algorithm>
#include <gtest/gtest.h>

#include "core/trace/embree_caster.h"
#include "core/trace/kd_caster.h"
#include "tests/support/brute_force.h"
#include "tests/support/trace_scenes.h"

namespace hybridrt {
namespace {

/// Triangles here and there, each up to five times, corners in any order and some of them zeros with a sign.
Scene copies(unsigned seed) {
  Random random(seed);
  Scene scene;
  std::vector<uvec3> triangles;
  for (int i = 0; i < 60; ++i) {
    vec3 corners[3];
    for (vec3& corner : corners) {
      corner = random.in_cube(-1, 1);
      for (int k = 0; k < 3; ++k)
        if (random.below(6) == 0) corner[k] = 0;
    }
    for (uint32_t copy = 0; copy <= random.below(5); ++copy) {
      const auto first = static_cast<uint32_t>(scene.positions.size());
      for (vec3 corner : corners) {
        for (int k = 0; k < 3; ++k)
          if (corner[k] == 0 && random.below(2) == 0) corner[k] = -0.0f;
        scene.positions.push_back(corner);
      }
      uvec3 triangle(first, first + 1, first + 2);
      std::shuffle(&triangle.x, &triangle.x + 3, random.engine);
      triangles.push_back(triangle);
    }
  }
  std::shuffle(triangles.begin(), triangles.end(), random.engine);
  scene.triangle_positions.assign(triangles.begin(), triangles.end());
  scene.bounds = compute_bounds(scene);
  return scene;
}

bool same_corners(const Scene& scene, uint32_t a, uint32_t b) {
  for (int i = 0; i < 3; ++i) {
    bool found = false;
    for (int k = 0; k < 3; ++k) found |= scene.vertex(a, i) == scene.vertex(b, k);
    if (!found) return false;
  }
  return true;
}

TEST(Coincident, AreFoundAsPairByPair) {
  for (unsigned seed = 0; seed < 20; ++seed) {
    const Scene scene = copies(seed);
    const CoincidentTriangles found = find_coincident(scene);
    const auto is_hidden = [&](uint32_t i) { return std::ranges::binary_search(found.hidden, i); };
    for (uint32_t i = 0; i < scene.triangle_count(); ++i) {
      size_t partners = 0;
      bool first_of_its_turn = true;
      for (uint32_t k = 0; k < scene.triangle_count(); ++k) {
        if (k == i || !same_corners(scene, i, k)) continue;
        partners += !is_hidden(k);
        const vec3 ni = glm::cross(scene.vertex(i, 1) - scene.vertex(i, 0), scene.vertex(i, 2) - scene.vertex(i, 0));
        const vec3 nk = glm::cross(scene.vertex(k, 1) - scene.vertex(k, 0), scene.vertex(k, 2) - scene.vertex(k, 0));
        first_of_its_turn &= !(k < i && glm::dot(ni, nk) > 0);
      }
      ASSERT_EQ(is_hidden(i), !first_of_its_turn) << i << " of seed " << seed;
      if (is_hidden(i)) continue;
      size_t linked = 0;
      if (!found.tied_of.empty() && found.tied_of[i] != CoincidentTriangles::kAlone)
        for (uint32_t at = found.tied[found.tied_of[i]].next; at != found.tied_of[i]; at = found.tied[at].next) {
          EXPECT_TRUE(same_corners(scene, i, found.tied[at].triangle));
          ++linked;
        }
      ASSERT_EQ(linked, partners) << i << " of seed " << seed;
    }
  }
}

TEST(Coincident, EveryCasterShowsTheSame) {
  size_t ties = 0;
  for (unsigned seed = 0; seed < 10; ++seed) {
    const Scene scene = copies(seed);
    ThreadPool pool(2);
    const KdTree tree = build_kd_tree(scene, pool);
    const std::vector<Ray<float>> rays = assorted_rays(scene, seed, 3000);
    const auto hits_of = [&](const RayCaster<float>& caster) {
      std::vector<Hit<float>> hits(rays.size());
      caster.closest_hits(rays, hits);
      return hits;
    };
    const auto simd = hits_of(*make_kd_caster(tree, LeafKernel::simd));
    const auto single = hits_of(*make_embree_caster(scene, 1, EmbreeRays::single));
    const auto packets = hits_of(*make_embree_caster(scene, 1));
    for (size_t i = 0; i < rays.size(); ++i) {
      const Hit<float> truth = brute_force_hit(scene, rays[i]);
      ASSERT_EQ(simd[i].triangle, truth.triangle);
      for (const Hit<float>& embree : {single[i], packets[i]}) {
        if (!truth.found() || !embree.found() || !same_corners(scene, truth.triangle, embree.triangle)) continue;
        ++ties;
        ASSERT_EQ(embree.triangle, truth.triangle) << i << " of seed " << seed;
        EXPECT_NEAR(embree.u, truth.u, 1e-3f);
        EXPECT_NEAR(embree.v, truth.v, 1e-3f);
      }
    }
  }
  EXPECT_GT(ties, 10000u);
}

TEST(Coincident, ManyCopiesAreNoWork) {
  Scene scene;
  scene.positions = {vec3(0, 0, 0), vec3(1, 0, 0), vec3(0, 1, 0)};
  scene.triangle_positions.assign(200000, uvec3(0, 1, 2));
  scene.bounds = compute_bounds(scene);
  const CoincidentTriangles found = find_coincident(scene);
  EXPECT_EQ(found.hidden.size(), 199999u);
  EXPECT_TRUE(found.tied.empty());
  ThreadPool pool(1);
  EXPECT_EQ(build_kd_tree(scene, pool).triangles.size(), 1u);
}

}  // namespace
}  // namespace hybridrt
