// Fewer triangles within bounds: what must stay stays, and the distance is that of a brute force.

#include "core/simplify/simplify.h"

#include <gtest/gtest.h>
#include <set>
#include <tuple>

#include "core/mesh/weld.h"
#include "core/simplify/kept_vertices.h"
#include "tests/support/closed_mesh.h"
#include "tests/support/mesh_test.h"
#include "tests/support/simplify_scenes.h"
#include "tests/support/trace_scenes.h"

namespace hybridrt {
namespace {

Simplified simplified(const Scene& scene, const std::vector<float>& bounds) {
  ThreadPool pool(2);
  return simplify(scene, build_topology(scene, pool), bounds, pool);
}

float hills(float x, float z) { return 0.1f * std::sin(9 * x) * std::cos(7 * z); }

/// Points on all triangles of `a`, and how far the farthest is from `b`.
double brute_force_distance(const Scene& a, const Scene& b, uint32_t seed) {
  Random random(seed);
  double largest = 0;
  for (uint32_t t = 0; t < a.triangle_count(); ++t)
    for (int i = 0; i < 4; ++i) {
      double u = random.unit(), v = random.unit();
      if (u + v > 1) u = 1 - u, v = 1 - v;
      const dvec3 p = (1 - u - v) * dvec3(a.vertex(t, 0)) + u * dvec3(a.vertex(t, 1)) + v * dvec3(a.vertex(t, 2));
      largest = std::max(largest, brute_force_distance(b, p));
    }
  return largest;
}

size_t count_positions(const Scene& scene, auto&& is_counted) {
  std::set<std::tuple<float, float, float>> found;
  for (const uvec3& triangle : scene.triangle_positions)
    for (int k = 0; k < 3; ++k)
      if (const vec3 p = scene.positions[triangle[k]]; is_counted(p)) found.insert({p.x, p.y, p.z});
  return found.size();
}

TEST(Simplify, SphereStaysClosedAndWithinItsBound) {
  const Scene scene = with_built_normals(sphere_scene(48, 96));
  const float bound = 0.01f;
  const Simplified lean = simplified(scene, even_bounds(scene, bound));
  EXPECT_LT(lean.scene.triangle_count() * 6, scene.triangle_count());
  EXPECT_GT(lean.scene.triangle_count(), 50u);
  expect_closed(lean.scene);
  EXPECT_LE(lean.distance.hausdorff(), bound);
  EXPECT_LE(lean.distance.share, 1);
  EXPECT_LE(brute_force_distance(scene, lean.scene, 1), bound);
  EXPECT_LE(brute_force_distance(lean.scene, scene, 2), bound);
}

TEST(Simplify, BoundsHoldForAllCollapsesTogether) {
  for (const float bound : {0.0005f, 0.002f, 0.008f}) {
    const Scene scene = with_built_normals(terrain_scene(40, hills));
    const Simplified lean = simplified(scene, even_bounds(scene, bound));
    EXPECT_LT(lean.scene.triangle_count(), scene.triangle_count());
    EXPECT_LE(brute_force_distance(scene, lean.scene, 1), bound);
    EXPECT_LE(brute_force_distance(lean.scene, scene, 2), bound);
  }
}

TEST(Simplify, WhereABoundIsNotKeptItIsTriedAgain) {
  Random random(9);
  const Scene scene = with_built_normals(terrain_scene(40, [&](float, float) { return 0.008f * random.unit(); }));
  const float bound = 0.003f;
  const Simplified lean = simplified(scene, even_bounds(scene, bound));
  EXPECT_GT(lean.rounds, 1) << "a first round that keeps to it proves nothing";
  EXPECT_LE(lean.distance.share, 1);
  EXPECT_LE(brute_force_distance(scene, lean.scene, 1), bound);
  EXPECT_LE(brute_force_distance(lean.scene, scene, 2), bound);
  EXPECT_LT(lean.scene.triangle_count(), scene.triangle_count());
}

TEST(Decimate, SamplesStayWithinTheirBounds) {
  Random random(9);
  const Scene scene = with_built_normals(terrain_scene(40, [&](float, float) { return 0.008f * random.unit(); }));
  const float bound = 0.003f;
  ThreadPool pool(2);
  const Scene lean = decimate(scene, build_topology(scene, pool), even_bounds(scene, bound), pool);
  EXPECT_LT(lean.triangle_count() * 2, scene.triangle_count());
  for (uint32_t t = 0; t < scene.triangle_count(); ++t)
    for (int k = 0; k < 3; ++k) {
      const dvec3 a(scene.vertex(t, k)), b(scene.vertex(t, (k + 1) % 3));
      EXPECT_LE(brute_force_distance(lean, a), bound * 1.0001);
      EXPECT_LE(brute_force_distance(lean, (a + b) / 2.0), bound * 1.0001);
    }
}

TEST(Simplify, LargerBoundsLeaveFewerTriangles) {
  const Scene scene = with_built_normals(terrain_scene(40, hills));
  size_t before = scene.triangle_count() + 1;
  for (const float bound : {0.f, 0.0005f, 0.002f, 0.008f, 0.032f}) {
    const size_t now = simplified(scene, even_bounds(scene, bound)).scene.triangle_count();
    EXPECT_LT(now, before);
    before = now;
  }
}

TEST(Simplify, EachTriangleKeepsItsOwnBound) {
  const Scene scene = with_built_normals(terrain_scene(40, hills));
  std::vector<float> bounds;
  for (uint32_t t = 0; t < scene.triangle_count(); ++t) {
    const float x = (scene.vertex(t, 0).x + scene.vertex(t, 1).x + scene.vertex(t, 2).x) / 3;
    bounds.push_back(x < 0.5f ? 0 : 0.02f * (x - 0.45f));
  }
  const Simplified lean = simplified(scene, bounds);
  EXPECT_LT(lean.scene.triangle_count() * 3, scene.triangle_count() * 2);
  const auto left = [](const vec3& p) { return p.x <= 0.5f; };
  EXPECT_EQ(count_positions(lean.scene, left), count_positions(scene, left));
  for (uint32_t t = 0; t < scene.triangle_count(); ++t)
    for (int k = 0; k < 3; ++k) {
      const dvec3 p(scene.vertex(t, k));
      EXPECT_LE(brute_force_distance(lean.scene, p), bounds[t] + 1e-7) << p.x;
    }
}

TEST(Simplify, FlatGroundKeepsItsBorderAndSeams) {
  Scene scene = terrain_scene(16, [](float, float) { return 0.f; });
  scene.materials.push_back(scene.materials[0]);
  for (uint32_t t = 0; t < scene.triangle_count(); ++t)
    if (scene.vertex(t, 0).x + scene.vertex(t, 1).x + scene.vertex(t, 2).x > 1.5f) scene.triangle_materials[t] = 1;
  scene = with_built_normals(scene);
  const Simplified lean = simplified(scene, even_bounds(scene, 0.01f));
  const auto border = [](const vec3& p) { return p.x == 0 || p.x == 1 || p.z == 0 || p.z == 1; };
  const auto seam = [&](const vec3& p) { return p.x == 0.5f; };
  EXPECT_EQ(count_positions(lean.scene, border), 64u);
  EXPECT_EQ(count_positions(lean.scene, seam), 17u);
  EXPECT_LE(count_positions(lean.scene, [](const vec3&) { return true; }), 64u + 15u + 5u) << "hardly more is needed";
}

TEST(Simplify, CreasesStay) {
  const Scene roof = with_built_normals(terrain_scene(16, [](float x, float) { return std::min(x, 1 - x) * 2; }));
  const Simplified lean = simplified(roof, even_bounds(roof, 0.05f));
  EXPECT_LT(lean.scene.triangle_count(), roof.triangle_count() / 3);
  EXPECT_EQ(count_positions(lean.scene, [](const vec3& p) { return p.x == 0.5f; }), 17u);
}

TEST(Simplify, CornersKeepWhatTheyHave) {
  Scene scene = with_built_normals(terrain_scene(24, hills));
  Textures textures;
  textures.words = {0};
  textures.triangle_maps.assign(scene.triangle_count(), 0);
  Random random(5);
  for (uint32_t t = 0; t < scene.triangle_count(); ++t) {
    uvec3 texcoords, colors;
    for (int k = 0; k < 3; ++k) {
      const vec3 p = scene.vertex(t, k);
      // A cut in the texture where z is a half, one in the colours where x is.
      texcoords[k] = static_cast<uint32_t>(textures.texcoords.size());
      textures.texcoords.emplace_back(p.x, t >= scene.triangle_count() / 2 ? p.z + 7 : p.z);
      colors[k] = static_cast<uint32_t>(scene.colors.size());
      scene.colors.push_back(vec3(p.x < 0.5f, p.x, p.z));
    }
    textures.triangle_texcoords.push_back(texcoords);
    scene.triangle_colors.push_back(colors);
  }
  scene.textures = std::make_shared<const Textures>(textures);
  validate(scene);

  const auto corners_of = [](const Scene& s) {
    std::set<std::vector<float>> corners;
    for (uint32_t t = 0; t < s.triangle_count(); ++t)
      for (int k = 0; k < 3; ++k) {
        const vec3 p = s.vertex(t, k), n = s.normals[s.triangle_normals[t][k]], c = s.colors[s.triangle_colors[t][k]];
        const vec2 uv = s.textures->texcoords[s.textures->triangle_texcoords[t][k]];
        corners.insert({p.x, p.y, p.z, n.x, n.y, n.z, c.x, c.y, c.z, uv.x, uv.y});
      }
    return corners;
  };
  const Simplified lean = simplified(scene, even_bounds(scene, 0.01f));
  EXPECT_LT(lean.scene.triangle_count() * 2, scene.triangle_count());
  const auto before = corners_of(scene), after = corners_of(lean.scene);
  EXPECT_TRUE(std::includes(before.begin(), before.end(), after.begin(), after.end()));
  EXPECT_EQ(count_positions(lean.scene, [](const vec3& p) { return p.z == 0.5f; }), 25u);
  EXPECT_LT(lean.scene.normals.size(), scene.normals.size()) << "what is not used is left out";
  EXPECT_EQ(lean.scene.colors.size() <= 3 * lean.scene.triangle_count(), true);
}

TEST(Simplify, NonManifoldAndOddPartsAreLeftAlone) {
  Scene scene = sphere_scene(24, 48);
  for (vec3& p : scene.positions) p *= 0.3f;
  const auto first_odd = static_cast<uint32_t>(scene.triangle_count());
  add_cube(scene, {1, 0, 0});
  add_cube(scene, {2, 1, 0});  // they share an edge
  const auto base = static_cast<uint32_t>(scene.positions.size());
  for (const vec3& p : {vec3(0, 3, 0), vec3(1, 3, 0), vec3(0, 4, 0), vec3(1, 4, 0)}) scene.positions.push_back(p);
  scene.triangle_positions.push_back({base, base + 1, base + 2});
  scene.triangle_positions.push_back({base + 1, base + 2, base + 3});  // wound the other way
  scene.triangle_positions.push_back({base, base + 1, base + 2});      // twice
  scene.triangle_materials.resize(scene.triangle_count(), 0);
  scene = with_built_normals(scene);
  const Simplified lean = simplified(scene, even_bounds(scene, 0.02f));
  const uint32_t odd = static_cast<uint32_t>(scene.triangle_count()) - first_odd;
  ASSERT_GT(lean.scene.triangle_count(), odd);
  EXPECT_LT(lean.scene.triangle_count() - odd, first_odd / 4);
  for (uint32_t i = 0; i < odd; ++i)
    for (int k = 0; k < 3; ++k)
      EXPECT_EQ(lean.scene.vertex(static_cast<uint32_t>(lean.scene.triangle_count()) - odd + i, k),
                scene.vertex(first_odd + i, k));
}

TEST(Simplify, BodiesThatTouchInAPointStayTwo) {
  Scene scene = sphere_scene(24, 48), other = scene;
  const auto base = static_cast<uint32_t>(scene.positions.size());
  for (const vec3& p : other.positions) scene.positions.push_back(p + vec3(0, 2, 0));
  for (const uvec3& t : other.triangle_positions) scene.triangle_positions.push_back(t + base);
  scene.triangle_materials.resize(scene.triangle_count(), 0);
  scene = with_built_normals(with_own_vertices(scene));  // connected by place, not by index
  const Simplified lean = simplified(scene, even_bounds(scene, 0.02f));
  EXPECT_LT(lean.scene.triangle_count() * 3, scene.triangle_count());
  EXPECT_EQ(topology_of(lean.scene).components.size(), 2u);
}

TEST(Fans, PointsWhereSeveralMeetAreKeptWithTheirNeighbours) {
  Scene scene = sphere_scene(24, 48), other = scene;
  const auto base = static_cast<uint32_t>(scene.positions.size());
  for (const vec3& p : other.positions) scene.positions.push_back(p + vec3(0, 2, 0));
  for (const uvec3& t : other.triangle_positions) scene.triangle_positions.push_back(t + base);
  scene.triangle_materials.resize(scene.triangle_count(), 0);
  scene = with_built_normals(scene);
  ThreadPool pool(2);
  const std::vector<uint32_t> welded = weld_positions(scene.positions, pool);
  const Fans fans = find_fans(scene, build_topology(scene, pool), welded, even_bounds(scene, 1));
  EXPECT_EQ(fans.vertex_of_fan.size(), scene.positions.size()) << "the point has a fan in each body";
  size_t kept = 0;
  for (size_t fan = 0; fan < fans.kept.size(); ++fan) {
    const vec3 p = scene.positions[fans.vertex_of_fan[fan]];
    const bool near = p.y > std::cos(1.01f * float(kPi) / 24) && p.y < 2 - std::cos(1.01f * float(kPi) / 24);
    EXPECT_EQ(fans.kept[fan] != 0, near) << p.y;
    kept += fans.kept[fan];
  }
  EXPECT_EQ(kept, 2u + 2 * 48);
}

TEST(Simplify, SmallClosedBodiesStayBodies) {
  const Scene scene = with_built_normals(sphere_scene(8, 12));
  const Simplified lean = simplified(scene, even_bounds(scene, 10));
  expect_closed(lean.scene);
  EXPECT_GE(lean.scene.triangle_count(), 4u);
  EXPECT_GT(topology_of(lean.scene).components[0].volume, 0);
}

TEST(Simplify, SameAtAnySizeAndPlace) {
  const Scene scene = with_built_normals(terrain_scene(24, hills));
  const size_t expected = simplified(scene, even_bounds(scene, 0.004f)).scene.triangle_count();
  for (const float scale : {0x1p-40f, 0x1p40f}) {
    Scene scaled = scene;
    for (vec3& p : scaled.positions) p *= scale;
    scaled.bounds = compute_bounds(scaled);
    const Simplified lean = simplified(scaled, even_bounds(scaled, 0.004f * scale));
    EXPECT_EQ(lean.scene.triangle_count(), expected) << scale;
  }
}

TEST(Simplify, StopsWhenAsked) {
  const Scene scene = with_built_normals(terrain_scene(120, hills));
  ThreadPool pool(2);
  const Topology topology = build_topology(scene, pool);
  const std::vector<float> bounds = even_bounds(scene, 1);
  const size_t whole = decimate(scene, topology, bounds, pool).triangle_count();
  EXPECT_GT(decimate(scene, topology, bounds, pool, [] { return true; }).triangle_count(), 2 * whole);
}

}  // namespace
}  // namespace hybridrt
