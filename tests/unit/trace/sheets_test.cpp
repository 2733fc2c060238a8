// How triangles continue one another, and what a light buffer's cells answer by it: their answers must be right
// wherever sheets end, fold, are wound both ways or lie on top of each other.

#include "core/trace/sheets.h"

#include <gtest/gtest.h>

#include "core/trace/kd_caster.h"
#include "core/trace/light_buffer.h"
#include "core/trace/surface_at.h"
#include "tests/support/brute_force.h"
#include "tests/support/trace_scenes.h"

namespace hybridrt {
namespace {

void finish(Scene& scene) {
  scene.triangle_materials.assign(scene.triangle_count(), 0);
  scene.materials.resize(1);
  scene.bounds = compute_bounds(scene);
}

/// A rolling ground over [0, 1] x [0, 1], two triangles per square.
Scene ground(int squares, float height, float overhang = 0) {
  Scene scene;
  for (int j = 0; j <= squares; ++j)
    for (int i = 0; i <= squares; ++i) {
      const float x = static_cast<float>(i) / static_cast<float>(squares);
      const float z = static_cast<float>(j) / static_cast<float>(squares);
      const float y = height * std::sin(13 * x + 1) * std::cos(9 * z);
      scene.positions.push_back({x + overhang * std::sin(40 * y), y, z});
    }
  const auto corner = [&](int i, int j) { return static_cast<uint32_t>(j * (squares + 1) + i); };
  for (int j = 0; j < squares; ++j)
    for (int i = 0; i < squares; ++i) {
      scene.triangle_positions.push_back({corner(i, j), corner(i, j + 1), corner(i + 1, j)});
      scene.triangle_positions.push_back({corner(i + 1, j), corner(i, j + 1), corner(i + 1, j + 1)});
    }
  return scene;
}

/// Calls body(random, triangle, triangles so far) for every triangle and drops those for which it is false.
template <typename Body>
Scene edited(Scene scene, uint32_t seed, const Body& body) {
  Random random(seed);
  std::vector<uvec3> kept;
  for (uvec3 triangle : scene.triangle_positions)
    if (body(random, triangle, kept)) kept.push_back(triangle);
  scene.triangle_positions = kept;
  return scene;
}

struct Case {
  std::string name;
  Scene scene;
  double least_answered;  ///< share of the queries
};

std::vector<Case> cases() {
  std::vector<Case> all;
  const auto add = [&](const char* name, Scene scene, double least_answered) {
    finish(scene);
    all.push_back({name, std::move(scene), least_answered});
  };
  using Kept = std::vector<uvec3>;
  add("Ground", ground(150, 0.05f), 0.9);
  add("GroundWithOverhangs", ground(150, 0.1f, 0.05f), 0.6);
  add("GroundWithTornOutTriangles",
      edited(ground(150, 0.05f), 1, [](Random& random, uvec3&, Kept&) { return random.below(40) != 0; }), 0.4);
  add("GroundWithTrianglesWoundTheWrongWay",
      edited(ground(150, 0.05f), 2,
             [](Random& random, uvec3& triangle, Kept&) {
               if (random.below(40) == 0) std::swap(triangle.x, triangle.y);
               return true;
             }),
      0.4);
  add("GroundWithDoubledTriangles",
      edited(ground(150, 0.05f), 3,
             [](Random& random, uvec3& triangle, Kept& kept) {
               if (random.below(40) == 0) kept.push_back(triangle);
               return true;
             }),
      0.4);

  Scene bodies;
  const auto add_body = [&](const Scene& body) {
    const auto first = static_cast<uint32_t>(bodies.positions.size());
    bodies.positions.insert(bodies.positions.end(), body.positions.begin(), body.positions.end());
    for (const uvec3& triangle : body.triangle_positions) bodies.triangle_positions.push_back(triangle + first);
  };
  Random random(4);
  for (int i = 0; i < 9; ++i)  // apart, so that no point of one lies inside another
    add_body(transformed(closed_sphere(90, 45), random.between(0.1f, 0.17f), vec3(i % 3, 1, i / 3) * 0.35f));
  add("ClosedBalls", bodies, 0.8);
  add("BallsWoundInward",
      edited(bodies, 7,
             [](Random&, uvec3& triangle, Kept&) {
               std::swap(triangle.x, triangle.y);
               return true;
             }),
      0.8);
  add_body(ground(100, 0.02f));
  add("BallsAboveGround", bodies, 0.8);
  add("BallsAndGroundWithCracks", edited(bodies, 5, [](Random& r, uvec3&, Kept&) { return r.below(200) != 0; }), 0.4);
  return all;
}

/// Queries from points of triangles, on the side that faces the light.
std::vector<ShadowQuery> surface_queries(const Scene& scene, const dvec3& toward, Random& random, int count) {
  std::vector<ShadowQuery> queries;
  for (int i = 0; i < count; ++i) {
    const uint32_t triangle = random.below(static_cast<uint32_t>(scene.triangle_count()));
    const dvec3 a(scene.vertex(triangle, 0)), e1 = dvec3(scene.vertex(triangle, 1)) - a,
                                              e2 = dvec3(scene.vertex(triangle, 2)) - a;
    const double u = i % 8 ? random.unit() : 0, v = random.unit() * (1 - u);
    dvec3 side = glm::normalize(glm::cross(e1, e2));
    const bool from_front = glm::dot(side, toward) > 0;
    if (!from_front) side = -side;
    if (glm::dot(side, toward) > 0)
      queries.push_back({a + u * e1 + v * e2 + kRelativeOffset<double> * 2 * side, triangle, from_front, false, true});
  }
  return queries;
}

TEST(Sheets, CellAnswersAreNeverWrong) {
  const dvec3 lights[] = {{0, 1, 0},      {1, 0, 0},       {0.3, 1, -0.2}, {-1, 0.1, 0.4},
                          {1, 0.01, 0.3}, {0.02, 1, 0.03}, {0.6, -1, 0.1}, {-1, 1, 1}};
  ThreadPool pool(2);
  for (const Case& given : cases()) {
    SCOPED_TRACE(given.name);
    const Scene& scene = given.scene;
    const Sheets sheets = make_sheets(scene, build_topology(scene, pool), pool);
    const KdTree tree = build_kd_tree(scene, pool);
    const auto reference = make_reference_caster(tree);
    Random random(6);
    size_t asked = 0, answered = 0, wrong = 0, shadowed = 0;
    for (const dvec3& light : lights) {
      const dvec3 toward = glm::normalize(light);
      const LightBuffer buffer = build_light_buffer(scene, sheets, toward, pool);
      const std::vector<ShadowQuery> queries = surface_queries(scene, toward, random, 2500);
      std::vector<CellAnswer> answers(queries.size());
      answers_of_cells(buffer, queries, answers);
      std::vector<Ray<double>> rays;
      for (const ShadowQuery& query : queries) rays.push_back({query.origin, toward});
      std::vector<uint8_t> occluded(queries.size());
      reference->any_hits(rays, occluded);
      for (size_t i = 0; i < queries.size(); ++i) {
        if (answers[i] == CellAnswer::inside) continue;
        ++asked, shadowed += occluded[i];
        if (answers[i] != CellAnswer::lit && answers[i] != CellAnswer::shadow) continue;
        ++answered;
        const bool says_shadow = answers[i] == CellAnswer::shadow;
        if (says_shadow == (occluded[i] != 0)) continue;
        wrong += says_shadow || brute_force_occluder(scene, toward, queries[i]) !=
                                    kNoTriangle;  // else it was its own triangle's rounding
      }
    }
    EXPECT_EQ(wrong, 0u);
    EXPECT_GT(shadowed, asked / 20);
    const double share = static_cast<double>(answered) / static_cast<double>(asked);
    RecordProperty(given.name, std::to_string(share));
    EXPECT_GT(share, given.least_answered);
  }
}

bool share_an_edge_in_opposite_directions(const Scene& scene, uint32_t a, int side_of_a, uint32_t b) {
  for (int k = 0; k < 3; ++k)
    if (scene.vertex(a, side_of_a) == scene.vertex(b, (k + 1) % 3) &&
        scene.vertex(a, (side_of_a + 1) % 3) == scene.vertex(b, k))
      return true;
  return false;
}

TEST(Sheets, AcrossIsWhatBruteForceFinds) {
  ThreadPool pool(2);
  for (const NamedScene& named : all_test_scenes()) {
    const Scene& scene = named.scene;
    if (scene.triangle_count() > 3000) continue;
    SCOPED_TRACE(named.name);
    const Sheets sheets = make_sheets(scene, build_topology(scene, pool), pool);
    const auto is_flat = [&](uint32_t t) {  // welding leaves it fewer than three corners
      return scene.vertex(t, 0) == scene.vertex(t, 1) || scene.vertex(t, 1) == scene.vertex(t, 2) ||
             scene.vertex(t, 2) == scene.vertex(t, 0);
    };
    const auto has_side = [&](uint32_t t, const vec3& p, const vec3& q) {
      for (int k = 0; k < 3; ++k) {
        const vec3 from = scene.vertex(t, k), to = scene.vertex(t, (k + 1) % 3);
        if ((from == p && to == q) || (from == q && to == p)) return true;
      }
      return false;
    };
    for (uint32_t t = 0; t < scene.triangle_count(); ++t)
      for (int k = 0; k < 3; ++k) {
        std::vector<uint32_t> beside;
        for (uint32_t other = 0; other < scene.triangle_count() && !is_flat(t); ++other)
          if (other != t && !is_flat(other) && has_side(other, scene.vertex(t, k), scene.vertex(t, (k + 1) % 3)))
            beside.push_back(other);
        const bool goes_on = beside.size() == 1 && share_an_edge_in_opposite_directions(scene, t, k, beside[0]);
        ASSERT_EQ(sheets.across[t][k], goes_on ? beside[0] : kNoTriangle) << t << ' ' << k;
      }
  }
}

}  // namespace
}  // namespace hybridrt
