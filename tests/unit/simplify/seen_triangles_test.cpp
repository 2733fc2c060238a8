// A room in which each triangle is seen in one way only, or not at all.

#include "core/simplify/seen_triangles.h"

#include <gtest/gtest.h>

#include "tests/support/simplify_scenes.h"

namespace hybridrt {
namespace {

enum Part : uint32_t {
  in_front,
  behind_it,
  behind_the_eye,
  over_the_floor,
  beyond_the_floor,
  floor_1,
  floor_2,
  mirror_1,
  mirror_2
};

/// The eye at (0, 1, 5) looks along -z at a mirror at z = -8.
Scene room() {
  std::vector<vec3> positions;
  std::vector<uvec3> triangles;
  const auto add = [&](const vec3& a, const vec3& b, const vec3& c) {
    const auto first = static_cast<uint32_t>(positions.size());
    positions.insert(positions.end(), {a, b, c});
    triangles.push_back({first, first + 1, first + 2});
  };
  const auto upright = [&](const vec3& at, float size) {
    add(at + vec3(-size, -size, 0), at + vec3(size, -size, 0), at + vec3(0, size, 0));
  };
  const auto flat = [&](const vec3& at) { add(at + vec3(-1, 0, -1), at + vec3(0, 0, 1), at + vec3(1, 0, -1)); };
  upright({0, 1, 0}, 0.9f);
  upright({0, 0.9f, -1}, 0.1f);
  upright({3, 1, 12}, 0.5f);
  flat({2, 8, 0});
  flat({2, 8, 30});
  add({-10, 0, -10}, {-10, 0, 10}, {10, 0, 10});
  add({-10, 0, -10}, {10, 0, 10}, {10, 0, -10});
  add({-9, 0.01f, -8}, {9, 0.01f, -8}, {9, 2, -8});
  add({-9, 0.01f, -8}, {9, 2, -8}, {-9, 2, -8});
  Scene scene = bare_scene(std::move(positions), std::move(triangles));
  scene.materials.push_back(scene.materials[0]);
  scene.materials[1].reflect = vec3(0.9f);
  for (uint32_t t : {mirror_1, mirror_2}) scene.triangle_materials[t] = 1;
  return with_built_normals(scene);
}

std::vector<uint8_t> kept(const Scene& scene, int depth, const std::vector<dvec3>& toward_lights, int threads = 2) {
  ThreadPool pool(threads);
  SeenTriangles seen(scene, depth, pool);
  seen.look({make_view({{0, 1, 5}, {0, 1, 0}, {0, 1, 0}, 0.9}, dvec3(0), 160, 120), toward_lights});
  return seen.kept(build_topology(scene, pool));
}

TEST(SeenTriangles, DirectlyInAMirrorAndByTheirShadow) {
  const Scene scene = room();
  const auto plain = kept(scene, 0, {}), mirrored = kept(scene, 1, {}), lit = kept(scene, 0, {{0, 1, 0}});
  for (uint32_t t : {in_front, floor_1, floor_2, mirror_1, mirror_2}) EXPECT_TRUE(plain[t]) << t;
  for (uint32_t t : {behind_it, behind_the_eye, over_the_floor, beyond_the_floor}) EXPECT_FALSE(plain[t]) << t;
  EXPECT_TRUE(mirrored[behind_the_eye]);
  EXPECT_FALSE(mirrored[over_the_floor]);
  EXPECT_TRUE(lit[over_the_floor]);
  EXPECT_FALSE(lit[behind_the_eye]);
  for (const auto& any : {plain, mirrored, lit, kept(scene, 4, {{0, 1, 0}})}) EXPECT_FALSE(any[beyond_the_floor]);
}

TEST(SeenTriangles, NeighboursAreKeptAndGlassIsKeptWhole) {
  Scene scene = sphere_scene(16, 24);
  for (const bool glass : {false, true}) {
    scene.materials[0].transmit = vec3(glass ? 1 : 0);
    scene.materials[0].ni = 1.5f;
    const Scene ball = with_built_normals(scene);
    const auto found = kept(ball, 0, {});
    const auto count = static_cast<size_t>(std::count(found.begin(), found.end(), 1));
    if (glass) {
      EXPECT_EQ(count, ball.triangle_count());
      continue;
    }
    EXPECT_GT(count, ball.triangle_count() / 3);
    EXPECT_LT(count, ball.triangle_count() * 2 / 3);
    for (uint32_t t = 0; t < ball.triangle_count(); ++t)
      for (int k = 0; k < 3; ++k) EXPECT_TRUE(found[t] || ball.vertex(t, k).z <= 0.5f) << "the near side";
  }
}

TEST(SeenTriangles, SameForAnyNumberOfThreads) {
  const Scene scene = room();
  const auto expected = kept(scene, 4, {{0, 1, 0}}, 1);
  for (int i = 0; i < 40; ++i) ASSERT_EQ(kept(scene, 4, {{0, 1, 0}}, 4), expected);
}

}  // namespace
}  // namespace hybridrt
