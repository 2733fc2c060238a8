// The light buffer against brute force in double precision: no answer may differ.

#include "core/trace/light_buffer.h"

#include <gtest/gtest.h>

#include "core/procedural/procedural.h"
#include "core/trace/kd_caster.h"
#include "core/trace/surface_at.h"
#include "tests/support/brute_force.h"
#include "tests/support/trace_scenes.h"

namespace hybridrt {
namespace {

std::vector<dvec3> light_directions(uint32_t seed) {
  std::vector<dvec3> directions = {{0, 1, 0}, {1, 0, 0}, {0, 0, -1}, {1, 1, 0}, {1e-9, 1, 0}, {1, 1e-3, 0.3}};
  Random random(seed);
  while (directions.size() < 12) directions.push_back(dvec3(random.direction()));
  for (dvec3& direction : directions) direction = glm::normalize(direction);
  return directions;
}

class LightBufferTest : public testing::TestWithParam<NamedScene> {
 protected:
  LightBuffer build(const Scene& scene, const dvec3& toward) {
    sheets_ = make_sheets(scene, build_topology(scene, pool_), pool_);
    return build_light_buffer(scene, sheets_, toward, pool_);
  }

  /// Queries from points of the triangles, corners and edges among them, on the side that faces the light.
  static std::vector<ShadowQuery> surface_queries(const Scene& scene, const dvec3& toward, uint32_t seed, int count) {
    Random random(seed);
    std::vector<ShadowQuery> queries;
    if (scene.triangle_count() == 0) return queries;
    for (int i = 0; i < count; ++i) {
      const uint32_t triangle = random.below(static_cast<uint32_t>(scene.triangle_count()));
      const dvec3 a(scene.vertex(triangle, 0)), b(scene.vertex(triangle, 1)), c(scene.vertex(triangle, 2));
      if (is_degenerate(vec3(a), vec3(b), vec3(c))) continue;
      double u = random.unit(), v = random.unit() * (1 - u);
      if (i % 8 == 0) u = 0;
      if (i % 16 == 0) v = 0;
      dvec3 side = glm::normalize(glm::cross(b - a, c - a));
      const bool from_front = glm::dot(side, toward) > 0;
      if (!from_front) side = -side;
      const dvec3 point = a + u * (b - a) + v * (c - a);
      const dvec3 size = glm::max(glm::abs(point), glm::max(glm::abs(b - a), glm::abs(c - a)));
      if (glm::dot(side, toward) <= 0) continue;
      queries.push_back({point + kRelativeOffset<double> * std::max({size.x, size.y, size.z}) * side, triangle,
                         from_front, /*anywhere=*/false, /*is_precise=*/true});
    }
    return queries;
  }

  /// Queries from anywhere in and around the scene.
  static std::vector<ShadowQuery> space_queries(const Scene& scene, const LightBuffer& buffer, uint32_t seed,
                                                int count) {
    Random random(seed);
    std::vector<ShadowQuery> queries;
    if (scene.triangle_count() == 0) return queries;
    for (int i = 0; i < count; ++i) {
      const dvec3 origin = dvec3(scene.bounds.center()) + dvec3(scene.bounds.extent() * random.in_cube(-0.7f, 0.7f));
      queries.push_back({origin, kNoTriangle, true, may_be_enclosed(buffer, origin)});
    }
    return queries;
  }

  static int wrong_answers(const Scene& scene, const LightBuffer& buffer, const std::vector<ShadowQuery>& queries) {
    std::vector<uint8_t> occluded(queries.size());
    shadow_answers(buffer, queries, occluded);
    int wrong = 0;
    for (size_t i = 0; i < queries.size(); ++i) wrong += truth(scene, buffer.toward, queries[i]) != (occluded[i] == 1);
    return wrong;
  }

  /// Tests every triangle but the query's own: a plane does not shadow itself. (In a sliver a million times as long as
  /// wide even double precision would find it in its own way.)
  static bool truth(const Scene& scene, const dvec3& toward, const ShadowQuery& query) {
    return brute_force_occluder(scene, toward, query) != kNoTriangle;
  }

  ThreadPool pool_{2};
  Sheets sheets_;  ///< the last buffer's
};

TEST_P(LightBufferTest, AnswersAsBruteForceInDouble) {
  const Scene& scene = GetParam().scene;
  int asked = 0;
  for (const dvec3& toward : light_directions(1)) {
    const LightBuffer buffer = build(scene, toward);
    const auto surface = surface_queries(scene, toward, 2, 300), space = space_queries(scene, buffer, 3, 300);
    EXPECT_EQ(wrong_answers(scene, buffer, surface), 0) << toward.x << ' ' << toward.y << ' ' << toward.z;
    EXPECT_EQ(wrong_answers(scene, buffer, space), 0) << toward.x << ' ' << toward.y << ' ' << toward.z;
    asked += static_cast<int>(surface.size() + space.size());
  }
  EXPECT_TRUE(asked > 3000 || scene.triangle_count() == 0);
}

TEST_P(LightBufferTest, ScaleAndDistanceFromTheOriginDoNotMatter) {
  const std::pair<float, vec3> moves[] = {{1e-4f, vec3(0)}, {1e6f, vec3(0)}, {1e3f, {1e6f, -1e6f, 3e5f}}};
  for (const auto& [scale, offset] : moves) {
    const Scene scene = transformed(GetParam().scene, scale, offset);
    const dvec3 toward = glm::normalize(dvec3(0.4, 0.8, -0.3));
    const LightBuffer buffer = build(scene, toward);
    EXPECT_EQ(wrong_answers(scene, buffer, surface_queries(scene, toward, 4, 1500)), 0) << scale;
    EXPECT_EQ(wrong_answers(scene, buffer, space_queries(scene, buffer, 5, 500)), 0) << scale;
  }
}

// Half a cache line an entry, and no slack: what --max-memory counts on.
TEST(LightBuffer, TakesAtMost80BytesPerTriangleOfABall) {
  ThreadPool pool(2);
  const Scene ball = closed_sphere(256, 128);
  const LightBuffer buffer = build_light_buffer(ball, make_sheets(ball, build_topology(ball, pool), pool),
                                                glm::normalize(dvec3(1, 2, 3)), pool);
  EXPECT_EQ(buffer.entries.capacity(), buffer.entries.size());
  EXPECT_EQ(buffer.others.capacity(), buffer.others.size());
  EXPECT_LE(memory_bytes(buffer), 80 * ball.triangle_count());
}

TEST_P(LightBufferTest, IsTheSameForAnyThreads) {
  const Scene& scene = GetParam().scene;
  const dvec3 toward = glm::normalize(dvec3(1, 2, 3));
  ThreadPool one(1), five(5);
  const Sheets sheets = make_sheets(scene, build_topology(scene, pool_), pool_);
  const LightBuffer a = build_light_buffer(scene, sheets, toward, one),
                    b = build_light_buffer(scene, sheets, toward, five);
  ASSERT_EQ(a.entries.size(), b.entries.size());
  if (!a.entries.empty()) {
    EXPECT_EQ(memcmp(a.entries.data(), b.entries.data(), a.entries.size() * sizeof(LightEntry)), 0);
  }
  EXPECT_EQ(memcmp(a.cells.data(), b.cells.data(), a.cells.size() * sizeof(LightCell)), 0);
  EXPECT_EQ(a.others, b.others);
}

INSTANTIATE_TEST_SUITE_P(Scenes, LightBufferTest, testing::ValuesIn(all_test_scenes()), test_name);

// Closed bodies that touch the ground and one another, wires thinner than a cell, blades: the queries of a frame.
class LightBufferOnProcedural : public testing::TestWithParam<const char*> {};

TEST_P(LightBufferOnProcedural, AnswersAsTheReferenceCaster) {
  ThreadPool pool(2);
  const Scene scene = find_procedural(GetParam())->make({{"triangles", 30000}});
  const Sheets sheets = make_sheets(scene, build_topology(scene, pool), pool);
  const KdTree tree = build_kd_tree(scene, pool);
  const auto reference = make_reference_caster(tree);
  const dvec3 center(scene.bounds.center()), size(scene.bounds.extent());

  Random random(7);
  size_t asked = 0, wrong = 0, shadowed = 0;
  for (const dvec3& toward : light_directions(8)) {
    const LightBuffer buffer = build_light_buffer(scene, sheets, toward, pool);
    // Points seen from outside, found by rays in double precision.
    std::vector<Ray<double>> seen;
    for (int i = 0; i < 20000; ++i) {
      const dvec3 eye = center + glm::length(size) * dvec3(random.direction());
      const dvec3 target = center + 0.5 * size * dvec3(random.in_cube(-1, 1));
      seen.push_back({eye, glm::normalize(target - eye)});
    }
    std::vector<Hit<double>> hits(seen.size());
    reference->closest_hits(seen, hits);
    std::vector<ShadowQuery> queries;
    std::vector<Ray<double>> rays;
    for (size_t i = 0; i < hits.size(); ++i) {
      if (!hits[i].found()) continue;
      const Surface<double> surface = surface_at(scene, hits[i].triangle, hits[i].u, hits[i].v, seen[i].dir);
      if (glm::dot(surface.side, toward) <= 0) continue;
      rays.push_back(leave(surface, toward));
      queries.push_back({rays.back().origin, hits[i].triangle, surface.from_outside});
    }
    std::vector<uint8_t> occluded(queries.size()), truth(queries.size());
    shadow_answers(buffer, queries, occluded);
    reference->any_hits(rays, truth);
    for (size_t i = 0; i < truth.size(); ++i) wrong += occluded[i] != truth[i], shadowed += truth[i];
    asked += truth.size();
  }
  EXPECT_EQ(wrong, 0u);
  EXPECT_GT(asked, 30000u);
  EXPECT_GT(shadowed, asked / 50) << "the scene hardly casts a shadow: nothing was tested";
  EXPECT_LT(shadowed, asked * 49 / 50);
}

INSTANTIATE_TEST_SUITE_P(Scenes, LightBufferOnProcedural, testing::Values("chess", "spheres", "thin"),
                         [](const auto& param) { return std::string(param.param); });

TEST(LightBuffer, KnowsWhoIsInsideAClosedBody) {
  const Scene ball = closed_sphere(32, 16);
  ThreadPool pool(1);
  const Sheets sheets = make_sheets(ball, build_topology(ball, pool), pool);
  const LightBuffer buffer = build_light_buffer(ball, sheets, glm::normalize(dvec3(0.1, 1, 0.2)), pool);
  EXPECT_TRUE(may_be_enclosed(buffer, {0.1, 0.2, 0.3}));
  EXPECT_FALSE(may_be_enclosed(buffer, {0.1, -1.5, 0.1})) << "below it";
  EXPECT_FALSE(may_be_enclosed(buffer, {0.1, 1.5, 0.1})) << "above it";
  EXPECT_FALSE(may_be_enclosed(buffer, {5, 0.5, 5})) << "beside it";

  uint8_t occluded;
  const ShadowQuery inside{{0.1, 0.2, 0.3}, kNoTriangle, true, true};
  shadow_answers(buffer, {&inside, 1}, {&occluded, 1});
  EXPECT_EQ(occluded, 1);
}

TEST(LightBuffer, OfASceneWithoutTrianglesShadowsNothing) {
  const Scene empty;
  ThreadPool pool(1);
  const LightBuffer buffer = build_light_buffer(empty, {}, {0, 1, 0}, pool);
  uint8_t occluded = 1;
  const ShadowQuery query{};
  shadow_answers(buffer, {&query, 1}, {&occluded, 1});
  EXPECT_EQ(occluded, 0);
  EXPECT_FALSE(may_be_enclosed(buffer, {0, 0, 0}));
}

}  // namespace
}  // namespace hybridrt
