#include "core/mesh/inside_out.h"

#include <gtest/gtest.h>
#include <numeric>
#include <random>

#include "core/mesh/point_in_body.h"
#include "tests/support/topology_scenes.h"

namespace hybridrt {
namespace {

using Numbers = std::vector<uint32_t>;

/// Appends `shape`, scaled and moved, inward if asked, with a normal per vertex that goes with the winding.
void add_shape(Scene& scene, const Scene& shape, const glm::mat3& turn, const vec3& at, bool inward,
               uint32_t material = 0) {
  const auto base = static_cast<uint32_t>(scene.positions.size());
  for (const vec3& p : shape.positions) {
    scene.positions.push_back(at + turn * p);
    scene.normals.push_back(glm::normalize(turn * (p - shape.bounds.center())) * (inward ? -1.f : 1.f));
  }
  for (uvec3 t : shape.triangle_positions) {
    if (inward) std::swap(t.y, t.z);
    scene.triangle_positions.push_back(base + t);
    scene.triangle_normals.push_back(base + t);
    scene.triangle_materials.push_back(material);
  }
}

Scene ball(float radius, bool inward, const vec3& at = vec3(0)) {
  Scene scene = bare_scene({}, {});
  add_shape(scene, sphere_scene(8, 12), glm::mat3(radius), at, inward);
  return scene;
}

void add_ball(Scene& scene, float radius, bool inward, const vec3& at = vec3(0), uint32_t material = 0) {
  add_shape(scene, sphere_scene(8, 12), glm::mat3(radius), at, inward, material);
}

Numbers inside_out(const Scene& scene) {
  ThreadPool pool(2);
  return find_inside_out(scene, topology_of(scene), pool);
}

Scene with_glass(Scene scene) {
  Material glass = default_material();
  glass.ni = 1.5f;
  glass.illum = 7;
  resolve_material(glass);
  scene.materials.push_back(glass);
  scene.materials.push_back(glass);
  return scene;
}

TEST(InsideOut, ABodyAloneIsTurned) {
  EXPECT_EQ(inside_out(ball(1, true)), Numbers{0});
  EXPECT_EQ(inside_out(ball(1, false)), Numbers{});
  Scene box = bare_scene({}, {});
  Scene cube = cube_scene();
  add_shape(box, cube, glm::mat3(1), vec3(0), true);
  EXPECT_EQ(inside_out(box), Numbers{0}) << "an empty room is a box";
}

TEST(InsideOut, CavitiesAndRoomsStay) {
  Scene bubble = ball(1, false);
  add_ball(bubble, 0.5f, true);
  EXPECT_EQ(inside_out(bubble), Numbers{}) << "a bubble";
  add_ball(bubble, 0.2f, true);
  EXPECT_EQ(inside_out(bubble), Numbers{2}) << "a thing in the bubble";

  Scene room = ball(10, true);
  add_ball(room, 1, false, {3, 0, 0});
  EXPECT_EQ(inside_out(room), Numbers{}) << "a sky dome";
  add_ball(room, 1, true, {-3, 0, 0});
  EXPECT_EQ(inside_out(room), Numbers{2}) << "a thing in the room";
  add_ball(room, 0.5f, true, {3, 0, 0});
  EXPECT_EQ(inside_out(room), Numbers{2}) << "a bubble in a thing in the room";
}

TEST(InsideOut, OpenThingsMakeARoomToo) {
  Scene room = ball(10, true);
  Scene sheet = bare_scene({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}});
  sheet.bounds.lo.z = -1;  // so that normals have a direction
  add_shape(room, sheet, glm::mat3(1), vec3(0), false);
  EXPECT_EQ(inside_out(room), Numbers{});
  Scene pierced = ball(10, true);
  add_shape(pierced, sphere_scene(8, 12), glm::mat3(2), {10, 0, 0}, false);
  EXPECT_EQ(inside_out(pierced), Numbers{0}) << "what sticks out is not in it";
}

TEST(InsideOut, WhatStandsOnTheFloorIsInTheRoom) {
  Scene room = bare_scene({}, {});
  add_shape(room, cube_scene(), glm::mat3(4), vec3(0), true);
  add_shape(room, cube_scene(), glm::mat3(1), vec3(0), false);  // in its corner
  EXPECT_EQ(inside_out(room), Numbers{});
  Scene beside = bare_scene({}, {});
  add_shape(beside, cube_scene(), glm::mat3(4), vec3(0), true);
  add_shape(beside, cube_scene(), glm::mat3(1), {4, 0, 0}, false);
  EXPECT_EQ(inside_out(beside), Numbers{0}) << "against its outer wall";
}

TEST(InsideOut, ABottleOfMirroredGlassIsTurnedAsAWhole) {
  for (const bool mirrored : {false, true}) {
    Scene bottle = with_glass(bare_scene({}, {}));
    add_ball(bottle, 1, mirrored, vec3(0), 1);
    add_ball(bottle, 0.9f, !mirrored, vec3(0), 1);   // its hollow
    add_ball(bottle, 0.1f, mirrored, vec3(0), 1);    // a marble of glass in it
    add_ball(bottle, 0.1f, false, {0.4f, 0, 0}, 0);  // and one of stone
    EXPECT_EQ(inside_out(bottle), mirrored ? (Numbers{0, 1, 2}) : Numbers{});
  }
  Scene outer_only = with_glass(bare_scene({}, {}));
  add_ball(outer_only, 1, true, vec3(0), 1);
  add_ball(outer_only, 0.9f, true, vec3(0), 1);
  EXPECT_EQ(inside_out(outer_only), Numbers{0}) << "the hollow is right as it is";
  Scene amber = with_glass(bare_scene({}, {}));
  add_ball(amber, 1, true, vec3(0), 1);
  add_ball(amber, 0.3f, false, vec3(0), 0);
  EXPECT_EQ(inside_out(amber), Numbers{0}) << "nobody stands in glass";
}

/// Bodies in bodies, built with a known parent of each.
struct Nest {
  Scene scene = bare_scene({}, {});
  std::vector<int> parent;
  std::vector<bool> inward;

  void add(std::mt19937& random, const vec3& at, float radius, int around, int levels) {
    const auto uniform = [&](double lo, double hi) {
      return static_cast<float>(std::uniform_real_distribution(lo, hi)(random));
    };
    const int own = static_cast<int>(parent.size());
    parent.push_back(around);
    inward.push_back(random() % 2);
    const bool is_ball = random() % 2;
    const dvec3 axis = glm::normalize(dvec3(uniform(0.1, 1), uniform(-1, 1), uniform(-1, 1)));
    const glm::dmat3 turn(axis, glm::normalize(glm::cross(axis, dvec3(0, 1, 0.1))),
                          glm::cross(axis, glm::normalize(glm::cross(axis, dvec3(0, 1, 0.1)))));
    const float scale = radius * (is_ball ? 1 : 1.15f);  // a cube of side 1.15 r fits into a ball of radius r
    Scene shape = is_ball ? sphere_scene(9, 14) : cube_scene();
    if (!is_ball)
      for (vec3& p : shape.positions) p -= 0.5f;
    shape.bounds = compute_bounds(shape);
    add_shape(scene, shape, glm::mat3(static_cast<double>(scale) * turn), at, inward[static_cast<size_t>(own)]);
    if (levels == 0) return;
    const int children = static_cast<int>(random() % 3);
    for (int i = 0; i < children; ++i)
      add(random, at + vec3((2 * i - children + 1) * 0.22f * radius, 0, 0), radius * uniform(0.1, 0.2), own,
          levels - 1);
  }

  /// By the tree alone.
  Numbers expected() const {
    const size_t count = parent.size();
    std::vector<int> solid(count), state(count);  // 1 body, -1 cavity, 0 room
    Numbers wrong;
    for (size_t i = 0; i < count; ++i) {
      const auto above = static_cast<size_t>(parent[i]);
      solid[i] = parent[i] < 0 ? 0 : solid[above] + state[above];
      const bool holds = std::count(parent.begin(), parent.end(), static_cast<int>(i)) > 0;
      state[i] = !inward[i] ? 1 : solid[i] > 0 ? -1 : holds ? 0 : 1;
      if (inward[i] && state[i] == 1) wrong.push_back(static_cast<uint32_t>(i));
    }
    return wrong;
  }
};

TEST(InsideOut, RandomNestsAreWhatTheyWereBuiltAs) {
  size_t turned = 0, inward = 0;
  for (uint32_t seed = 1; seed <= 60; ++seed) {
    std::mt19937 random(seed);
    Nest nest;
    for (int root = 0; root < 4; ++root) nest.add(random, vec3(3 * root, root % 2, 0), 1, -1, 4);
    const Numbers expected = nest.expected();
    EXPECT_EQ(inside_out(nest.scene), expected) << "seed " << seed;
    turned += expected.size();
    inward += static_cast<size_t>(std::count(nest.inward.begin(), nest.inward.end(), true));
  }
  EXPECT_GT(turned, 50u);
  EXPECT_GT(inward, turned + 50);
}

TEST(PointInBody, AgreesWithTheDistanceFromTheCentre) {
  const Scene scene = ball(1, true);
  Numbers all(scene.triangle_count());
  std::iota(all.begin(), all.end(), 0u);
  std::mt19937 random(5);
  std::uniform_real_distribution<double> uniform(-1.2, 1.2);
  std::vector<dvec3> points{dvec3(scene.positions[5]), dvec3(0)};
  for (int i = 0; i < 20000; ++i) points.emplace_back(uniform(random), uniform(random), uniform(random));
  const std::vector<Side> sides = sides_of(points, scene, all);
  EXPECT_EQ(sides[0], Side::unclear) << "a corner";
  for (size_t i = 1; i < points.size(); ++i) {
    const double radius = glm::length(points[i]);
    if (radius > 0.9 && radius < 1) continue;  // near the facets
    EXPECT_EQ(sides[i], radius < 1 ? Side::inside : Side::outside) << i;
  }
}

bool same(const Topology& a, const Topology& b) {
  const auto same_use = [](const EdgeUse& u, const EdgeUse& v) {
    return u.triangle == v.triangle && u.reversed == v.reversed;
  };
  return std::equal(a.uses.begin(), a.uses.end(), b.uses.begin(), b.uses.end(), same_use) &&
         std::equal(a.components.begin(), a.components.end(), b.components.begin(), b.components.end(),
                    [](const Component& c, const Component& d) { return c.winding == d.winding; });
}

TEST(TurnComponents, TurnsTrianglesNormalsTexcoordsAndTheTopology) {
  Scene scene = ball(1, true);
  add_ball(scene, 1, false, {3, 0, 0});
  scene.triangle_normals[200] = scene.triangle_normals[0];  // a normal that both need
  auto textures = std::make_shared<Textures>();
  textures->triangle_texcoords.assign(scene.triangle_count(), uvec3(7, 8, 9));
  scene.textures = textures;
  const Scene before = scene;
  Topology topology = topology_of(scene);
  turn_components(scene, topology, {0});
  EXPECT_TRUE(same(topology, topology_of(scene)));
  EXPECT_EQ(topology.components[0].winding, Winding::outward);
  for (uint32_t t = 0; t < scene.triangle_count(); ++t) {
    const bool turned = topology.component_of_triangle[t] == 0;
    EXPECT_EQ(textures->triangle_texcoords[t], turned ? uvec3(7, 9, 8) : uvec3(7, 8, 9));
    for (int corner = 0; corner < 3; ++corner) {
      const int was = turned ? (3 - corner) % 3 : corner;
      EXPECT_EQ(scene.vertex(t, corner), before.vertex(t, was));
      const vec3 normal = before.normals[before.triangle_normals[t][was]];
      EXPECT_EQ(scene.normals[scene.triangle_normals[t][corner]], turned ? -normal : normal) << t;
    }
  }
}

TEST(TurnComponents, NormalsThatWereRightStay) {
  Scene scene = ball(1, true);
  for (vec3& normal : scene.normals) normal = -normal;  // outward, unlike the triangles
  const std::vector<vec3> before = scene.normals;
  Topology topology = topology_of(scene);
  turn_components(scene, topology, {0});
  EXPECT_EQ(scene.normals, before);
}

TEST(TurnInsideOutBodies, WarnsOnce) {
  Scene scene = ball(1, true);
  add_ball(scene, 1, true, {3, 0, 0});
  Topology topology = topology_of(scene);
  ThreadPool pool(1);
  Warnings warnings;
  turn_inside_out_bodies(scene, topology, pool, warnings);
  ASSERT_EQ(warnings.size(), 1u);
  EXPECT_EQ(warnings[0].code, WarningCode::body_turned);
  const std::string& text = warnings[0].text;
  EXPECT_EQ(text.find("2 closed bodies were wound inward and are turned outward (first: "), 0u) << text;
  turn_inside_out_bodies(scene, topology, pool, warnings);
  EXPECT_EQ(warnings.size(), 1u) << "nothing is left to turn";
}

}  // namespace
}  // namespace hybridrt
