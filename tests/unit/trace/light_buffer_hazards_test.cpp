// What a light buffer must withstand: cameras in the middle of things, huge triangles, lights along walls.

#include <gtest/gtest.h>

#include "core/passes_cpu/trace_pass.h"
#include "core/trace/kd_caster.h"
#include "core/trace/light_buffer.h"
#include "core/trace/primary_surface.h"
#include "shaders/shared.h"
#include "tests/support/primary_shadow_query.h"
#include "tests/support/trace_scenes.h"

namespace hybridrt {
namespace {

uint8_t answer(const LightBuffer& buffer, const ShadowQuery& query) {
  uint8_t occluded = 2;
  shadow_answers(buffer, {&query, 1}, {&occluded, 1});
  return occluded;
}

/// Sheets in which no triangle continues another.
Sheets loose(const Scene& scene) {
  return {std::vector<int8_t>(scene.triangle_count()), {scene.triangle_count(), uvec3(kNoTriangle)}};
}

/// A box, and in it above its middle a pyramid that stands on its tip.
Scene top_in_a_box() {
  Scene scene = closed_box();
  const auto first = static_cast<uint32_t>(scene.positions.size());
  for (const vec3& p : {vec3(0.5f, 0.6f, 0.5f), vec3(0.3f, 0.8f, 0.3f), vec3(0.7f, 0.8f, 0.3f), vec3(0.7f, 0.8f, 0.7f),
                        vec3(0.3f, 0.8f, 0.7f)})
    scene.positions.push_back(p);
  for (const uvec3& corners :
       {uvec3(0, 1, 2), uvec3(0, 2, 3), uvec3(0, 3, 4), uvec3(0, 4, 1), uvec3(1, 3, 2), uvec3(1, 4, 3)})
    scene.triangle_positions.push_back(corners + first);
  return scene;
}

TEST(LightBufferHazards, AnEyeBelowACornerOrOnASurfaceMayBeInside) {
  // The ray up from the middle enters the pyramid by four triangles, and leaves it and the box by two each.
  const Scene scene = top_in_a_box();
  ThreadPool pool(1);
  const Topology topology = build_topology(scene, pool);
  ASSERT_EQ(topology.components.size(), 2u);
  for (const Component& component : topology.components) ASSERT_EQ(component.winding, Winding::outward);
  const Sheets sheets = make_sheets(scene, topology, pool);
  const LightBuffer buffer = build_light_buffer(scene, sheets, {0, 1, 0}, pool);
  EXPECT_TRUE(may_be_enclosed(buffer, {0.5, 0.3, 0.5}));
  EXPECT_FALSE(may_be_enclosed(buffer, {0.5, -0.3, 1.2}));
  for (const dvec3 on_it : {dvec3(0.3, 1, 0.3), dvec3(0, 0.3, 0.4), dvec3(0, 1, 0), dvec3(1, 0.5, 1)})
    EXPECT_TRUE(may_be_enclosed(buffer, on_it)) << "it looks into the box as well as out";
}

void add_scene(Scene& scene, const Scene& other) {
  const auto first = static_cast<uint32_t>(scene.positions.size());
  scene.positions.insert(scene.positions.end(), other.positions.begin(), other.positions.end());
  for (const uvec3& corners : other.triangle_positions) scene.triangle_positions.push_back(corners + first);
}

/// Boxes and balls on a grid, a few of each, which overlap, touch and share faces.
Scene bodies_on_a_grid(Random& random) {
  Scene scene;
  const auto corner = [&] { return vec3(random.below(6), random.below(6), random.below(6)); };
  for (uint32_t i = 1 + random.below(10); i > 0; --i)
    add_scene(scene, transformed(random.below(3) ? closed_box() : closed_sphere(8, 4),
                                 static_cast<float>(1 + random.below(3)), corner()));
  scene.bounds = compute_bounds(scene);
  return scene;
}

TEST(LightBufferHazards, EyesInsideAndOutsideAndOnBodiesThatOverlap) {
  const dvec3 lights[] = {{0, 1, 0}, {1, 0, 0}, {1, 1, 0}, {1, 1, 1}, {0.1, 1, 0.2}, {-1, 2, 0}};
  constexpr int kSize_px = 32;
  ThreadPool pool(1);
  Random random(1);
  size_t asked = 0, wrong = 0, enclosed = 0, views = 0;
  for (int round = 0; round < 60; ++round) {
    const Scene scene = bodies_on_a_grid(random);
    const Sheets sheets = make_sheets(scene, build_topology(scene, pool), pool);
    const KdTree tree = build_kd_tree(scene, pool);
    const auto reference = make_reference_caster(tree);
    const dvec3 eye(random.below(7), random.below(7), random.below(7)), target(random.in_cube(0, 6));
    const View view = make_view({eye, target, {0, 1, 0}, 1.2}, dvec3(0), kSize_px, kSize_px);
    for (const dvec3& light : lights) {
      const dvec3 toward = glm::normalize(light);
      const LightBuffer buffer = build_light_buffer(scene, sheets, toward, pool);
      const bool inside = may_be_enclosed(buffer, eye);
      ++views, enclosed += inside;
      for (int i = 0; i < kSize_px * kSize_px; ++i) {
        const Ray<double> seen{eye, glm::normalize(view.pixel_dir(i % kSize_px, i / kSize_px))};
        Hit<double> hit;
        reference->closest_hits({&seen, 1}, {&hit, 1});
        if (!hit.found()) continue;
        auto query = primary_shadow_query(scene, hit.triangle, eye, seen.dir, toward);
        if (!query) continue;
        query->anywhere = inside;
        const Ray<double> ray{query->origin, toward};
        uint8_t truth;
        reference->any_hits({&ray, 1}, {&truth, 1});
        ++asked, wrong += truth != answer(buffer, *query);
      }
    }
  }
  EXPECT_EQ(wrong, 0u);
  EXPECT_GT(asked, 50000u);
  EXPECT_GT(enclosed, views / 10);
  EXPECT_LT(enclosed, views * 9 / 10);
}

TEST(LightBufferHazards, AQueryThatMayLieAnywhereDoesNotMeetItsOwnTriangleEither) {
  const Scene scene = slivers(3, 400);
  const Sheets sheets = loose(scene);
  ThreadPool pool(1);
  const dvec3 toward = glm::normalize(dvec3(0.2, 1, 0.4));
  const LightBuffer buffer = build_light_buffer(scene, sheets, toward, pool);
  Random random(4);
  int asked = 0, other = 0;
  for (int i = 0; i < 20000; ++i) {
    const uint32_t triangle = random.below(static_cast<uint32_t>(scene.triangle_count()));
    const dvec3 a(scene.vertex(triangle, 0)), e1 = dvec3(scene.vertex(triangle, 1)) - a,
                                              e2 = dvec3(scene.vertex(triangle, 2)) - a;
    const double u = random.unit(), v = random.unit() * (1 - u);
    ShadowQuery query{a + u * e1 + v * e2, triangle};
    const uint8_t nowhere_else = answer(buffer, query);
    query.anywhere = true;
    other += answer(buffer, query) != nowhere_else;
    ++asked;
  }
  EXPECT_EQ(other, 0) << "of " << asked << ", on the very plane of a triangle";
}

TEST(LightBufferHazards, ManyTrianglesThatEachLieOverAllOfTheSceneTakeLittleMemory) {
  constexpr int kSheets = 20000;
  Scene scene;
  for (int i = 0; i < kSheets; ++i) {
    const float y = static_cast<float>(i) / kSheets;
    add_triangle(scene, {-1, y, -1}, {1, y, -1}, {0, y, 1});
  }
  scene.bounds = compute_bounds(scene);
  const Sheets sheets = loose(scene);
  ThreadPool pool(2);
  const LightBuffer buffer = build_light_buffer(scene, sheets, {0, 1, 0}, pool);
  EXPECT_LT(memory_bytes(buffer), size_t{kSheets} * 5000);
  for (const double height : {-1.0, 0.00002, 0.5, 0.99997})
    EXPECT_EQ(answer(buffer, {{0.1, height, 0.1}}), height < 0.99995) << height;
  EXPECT_EQ(answer(buffer, {{0.9, 0.5, 0.9}}), 0) << "beside them";
}

TEST(LightBufferHazards, AWallNearlyAlongTheLightIsLitAlikeByFramesAndByPass4) {
  // In single precision the light is parallel to the wall; in double it shines on it.
  Scene scene;
  add_triangle(scene, {-1, -1, -1}, {1, 1, -1}, {0, 0, 1});
  scene.normals = {glm::normalize(vec3(1, -1, 0))};
  scene.triangle_normals.assign(1, uvec3(0));
  scene.triangle_materials.assign(1, 0);
  scene.materials.resize(1);
  scene.bounds = compute_bounds(scene);
  constexpr int kWidth_px = 32, kHeight_px = 24;
  const View view = make_view({{3, -3, 0}, {0, 0, 0}, {0, 0, 1}, 0.8}, dvec3(0), kWidth_px, kHeight_px);
  ThreadPool pool(1);
  const KdTree tree = build_kd_tree(scene, pool);
  const auto caster = make_kd_caster(tree, LeafKernel::scalar);
  const Sheets sheets = loose(scene);
  for (const double lean : {1e-9, -1e-9}) {
    TraceJob job{scene, view, {{{glm::normalize(dvec3(1 + lean, 1, 0)), vec3(1)}}}};
    const LightBuffer buffer = build_light_buffer(scene, sheets, job.lights[0].light.toward, pool);
    job.lights[0].buffer = &buffer;
    std::vector<vec4> picture(kWidth_px * kHeight_px);
    std::vector<uint32_t> ids(picture.size());
    std::vector<uint8_t> lit(picture.size()), lit_again(picture.size());
    trace_frame(job, *caster, pool, TracedFrame<float>{picture, ids, lit});
    trace_pass(job, caster.get(), pool, {ids, {}, lit_again, {}});
    EXPECT_EQ(lit, lit_again);
    EXPECT_EQ(std::count(lit.begin(), lit.end(), HRT_MASK_LIT) > 20, lean > 0) << lean;
  }
}

}  // namespace
}  // namespace hybridrt
