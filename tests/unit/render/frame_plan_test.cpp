// What a frame needs, and what it can leave out.

#include "core/render/frame_plan.h"

#include <gtest/gtest.h>

#include "core/base/error.h"
#include "core/procedural/spheres.h"
#include "tests/support/trace_scenes.h"

namespace hybridrt {
namespace {

Scene plain_scene() {
  Scene scene = closed_box();
  scene.materials = {Material{}};
  scene.triangle_materials.assign(scene.triangle_count(), 0);
  scene.bounds = compute_bounds(scene);
  return scene;
}

Scene mirror_scene() {
  Scene scene = plain_scene();
  scene.materials.push_back(Material{});
  scene.materials[1].reflect = vec3(0.5f);
  scene.triangle_materials[3] = 1;
  return scene;
}

FrameRequest looking(const dvec3& eye, const dvec3& target) {
  FrameRequest request;
  request.number = 7;
  request.camera = {eye, target, {0, 1, 0}, 0.8};
  request.lights = {{glm::normalize(dvec3(1, 2, 3))}};
  return request;
}

const FrameRequest kTowards = looking({0.5, 0.5, 5}, {0.5, 0.5, 0.5});
const FrameRequest kAway = looking({0.5, 0.5, 5}, {0.5, 0.5, 10});

FramePlan plan_for(const Scene& scene, const RenderSettings& settings, const FrameRequest& request = kTowards) {
  return make_frame_plan(scene, make_scene_facts(scene), request, settings);
}

RenderSettings with(Method method, ShadowMode shadows) {
  RenderSettings s;
  s.method = method;
  s.shadows = shadows;
  return s;
}

TEST(FramePlan, CarriesTheRequest) {
  const FramePlan plan = plan_for(plain_scene(), {});
  EXPECT_EQ(plan.number, 7);
  ASSERT_EQ(plan.lights.size(), 1u);
  EXPECT_EQ(plan.lights[0].toward, kTowards.lights[0].toward);
  EXPECT_EQ(plan.view.width_px, 1024);
  EXPECT_GT(plan.near_distance, 0);
  EXPECT_LT(plan.near_distance, 0.001) << "it would cut away what is in view";
}

TEST(FramePlan, WithoutShadowsThereAreNoShadowPasses) {
  const FramePlan plan = plan_for(plain_scene(), with(Method::hybrid, ShadowMode::none));
  EXPECT_FALSE(plan.shadow_map);
  EXPECT_FALSE(plan.mark_blur);
  EXPECT_FALSE(plan.trace_shadows);
  EXPECT_FALSE(plan.trace());
  EXPECT_FALSE(plan.read_ids);
  EXPECT_FALSE(plan.read_mask);
}

TEST(FramePlan, ShadowModes) {
  const FramePlan map = plan_for(plain_scene(), with(Method::hybrid, ShadowMode::map));
  EXPECT_TRUE(map.shadow_map);
  EXPECT_FALSE(map.mark_blur || map.trace());
  EXPECT_FALSE(map.read_ids || map.read_mask) << "nothing on the CPU asks for them";

  const FramePlan blur = plan_for(plain_scene(), with(Method::hybrid, ShadowMode::blur));
  EXPECT_TRUE(blur.shadow_map && blur.mark_blur && blur.trace_shadows);
  EXPECT_TRUE(blur.read_ids && blur.read_mask);

  const FramePlan rays = plan_for(plain_scene(), with(Method::hybrid, ShadowMode::rays));
  EXPECT_TRUE(rays.trace_shadows && rays.read_ids);
  EXPECT_FALSE(rays.shadow_map || rays.mark_blur || rays.read_mask) << "every pixel has its ray";
}

TEST(FramePlan, GenerationsOnlyForMaterialsThatSendRaysOn) {
  const RenderSettings none = with(Method::hybrid, ShadowMode::none);
  EXPECT_FALSE(plan_for(plain_scene(), none).trace_scattered);
  EXPECT_TRUE(plan_for(mirror_scene(), none).trace_scattered);
  EXPECT_TRUE(plan_for(mirror_scene(), none).read_ids);

  Scene glass = plain_scene();
  glass.materials[0].transmit = vec3(0, 0.1f, 0);
  EXPECT_TRUE(plan_for(glass, none).trace_scattered);

  Scene schlick = plain_scene();
  schlick.materials[0].fresnel = Fresnel::schlick;  // black straight on, a mirror at a grazing angle
  EXPECT_TRUE(plan_for(schlick, none).trace_scattered);

  Scene unused = plain_scene();
  unused.materials.push_back(Material{});
  unused.materials[1].reflect = vec3(1);
  EXPECT_FALSE(plan_for(unused, none).trace_scattered) << "no triangle has the mirror's material";
}

TEST(FramePlan, NoGenerationsWhenTheMirrorIsOutOfView) {
  EXPECT_TRUE(plan_for(mirror_scene(), {}, kTowards).trace_scattered);
  EXPECT_FALSE(plan_for(mirror_scene(), {}, kAway).trace_scattered);
}

TEST(FramePlan, DepthZeroHasNoGenerations) {
  RenderSettings settings;
  settings.reflection_depth = 0;
  EXPECT_FALSE(plan_for(mirror_scene(), settings).trace_scattered);
  EXPECT_TRUE(plan_for(mirror_scene(), settings).trace_shadows);
}

TEST(FramePlan, RasterTracesNothing) {
  for (ShadowMode shadows : {ShadowMode::none, ShadowMode::map}) {
    const FramePlan plan = plan_for(mirror_scene(), with(Method::raster, shadows));
    EXPECT_FALSE(plan.trace() || plan.mark_blur || plan.read_ids || plan.read_mask);
    EXPECT_EQ(plan.shadow_map, shadows == ShadowMode::map);
  }
}

TEST(FramePlan, AovsReadWhatTheyShow) {
  for (uint32_t aov : {kAovId, kAovDepth, kAovNormal}) {
    RenderSettings settings = with(Method::raster, ShadowMode::none);
    settings.aovs = aov;
    EXPECT_TRUE(plan_for(plain_scene(), settings).read_ids) << aov;
  }
  RenderSettings settings = with(Method::raster, ShadowMode::map);
  settings.aovs = kAovShadow;
  EXPECT_TRUE(plan_for(plain_scene(), settings).read_mask);
}

TEST(FramePlan, IsPure) {
  const Scene scene = mirror_scene();
  const FramePlan a = plan_for(scene, {}), b = plan_for(scene, {});
  EXPECT_EQ(a.view.eye, b.view.eye);
  EXPECT_EQ(a.near_distance, b.near_distance);
  EXPECT_EQ(a.trace_scattered, b.trace_scattered);
}

TEST(SceneFacts, ScatteringBoundsHoldTheMirrorsOnly) {
  const Scene scene = mirror_scene();
  const SceneFacts facts = make_scene_facts(scene);
  Aabb expected;
  for (int corner = 0; corner < 3; ++corner) expected.grow(scene.vertex(3, corner));
  EXPECT_EQ(facts.scattering_bounds.lo, expected.lo);
  EXPECT_EQ(facts.scattering_bounds.hi, expected.hi);
  EXPECT_TRUE(make_scene_facts(plain_scene()).scattering_bounds.empty());
}

/// Whether any of many points of the box falls inside the picture.
bool a_point_is_seen(const View& view, const Aabb& box) {
  constexpr int kSteps = 12;
  for (int x = 0; x <= kSteps; ++x)
    for (int y = 0; y <= kSteps; ++y)
      for (int z = 0; z <= kSteps; ++z) {
        const dvec3 p = dvec3(box.lo) + dvec3(x, y, z) / double(kSteps) * dvec3(box.extent()) - view.eye;
        const double depth = glm::dot(p, view.forward);
        if (depth > 0 && std::abs(glm::dot(p, view.right)) <= depth * view.tan_half_width &&
            std::abs(glm::dot(p, view.up)) <= depth * view.tan_half_height)
          return true;
      }
  return false;
}

// It may err toward true only, and must do so rarely.
TEST(MayBeSeen, NeverLosesABoxThatIsInView) {
  Random random(12);
  int seen = 0, left_out = 0, needless = 0;
  for (int i = 0; i < 4000; ++i) {
    Camera camera{dvec3(random.in_cube(-5, 5)), dvec3(random.in_cube(-5, 5)), dvec3(random.direction()),
                  random.between(0.2f, 2.5f)};
    const View view = make_view(camera, dvec3(0), 16, 9);
    const vec3 corner = random.in_cube(-6, 6);
    Aabb box;
    box.grow(corner);
    box.grow(corner + random.in_cube(0, i % 2 ? 0.5f : 8));
    const bool truth = a_point_is_seen(view, box), answer = may_be_seen(view, box);
    ASSERT_TRUE(answer || !truth) << i;
    seen += truth;
    left_out += !answer;
    needless += answer && !truth;
  }
  EXPECT_GT(seen, 800);
  EXPECT_GT(left_out, 800);
  EXPECT_LT(needless, left_out / 5);
}

TEST(MayBeSeen, EmptyBoxesAndTheEyesOwn) {
  const View view = make_view(kTowards.camera, dvec3(0), 16, 9);
  EXPECT_FALSE(may_be_seen(view, Aabb{}));
  EXPECT_TRUE(may_be_seen(view, {vec3(-100), vec3(100)}));
  Aabb point;
  point.grow(vec3(0.5f, 0.5f, 0.5f));
  EXPECT_TRUE(may_be_seen(view, point));
}

TEST(MethodsAndShadows, TheTable) {
  const std::vector<std::pair<Method, std::vector<ShadowMode>>> allowed = {
      {Method::hybrid, {ShadowMode::none, ShadowMode::map, ShadowMode::blur, ShadowMode::rays}},
      {Method::raster, {ShadowMode::none, ShadowMode::map}},
      {Method::raytrace, {ShadowMode::none, ShadowMode::rays}},
      {Method::reference, {ShadowMode::none, ShadowMode::rays}}};
  for (const auto& [method, modes] : allowed) {
    EXPECT_NO_THROW(require_method_takes(method, default_shadows(method)));
    for (ShadowMode mode : {ShadowMode::none, ShadowMode::map, ShadowMode::blur, ShadowMode::rays}) {
      const bool takes = std::find(modes.begin(), modes.end(), mode) != modes.end();
      try {
        require_method_takes(method, mode);
        EXPECT_TRUE(takes) << name_of(method) << ' ' << name_of(mode);
      } catch (const Error& refused) {
        EXPECT_FALSE(takes) << refused.what();
        EXPECT_EQ(refused.kind(), ErrorKind::usage);
      }
    }
  }
  EXPECT_EQ(default_shadows(Method::reference), ShadowMode::rays);
}

TEST(FramePlan, PassesRunForThoseThatCastShadows) {
  const Scene scene = make_spheres({300, 0});
  const SceneFacts facts = make_scene_facts(scene);
  FrameRequest request;
  request.camera = {{0, 1, 5}, {0, 0, 0}, {0, 1, 0}, 0.8};
  const auto plan = [&](ShadowMode shadows) {
    RenderSettings settings;
    settings.shadows = shadows;
    return make_frame_plan(scene, facts, request, settings);
  };
  const DirectionalLight casts, casts_none{dvec3(1, 0, 0), vec3(1), false};
  for (const auto& lights : {std::vector<DirectionalLight>(), {casts_none}, {casts_none, casts_none}}) {
    request.lights = lights;
    for (const ShadowMode mode : {ShadowMode::map, ShadowMode::blur, ShadowMode::exact, ShadowMode::rays}) {
      const FramePlan p = plan(mode);
      EXPECT_FALSE(p.shadows || p.shadow_map || p.mark_blur || p.mark_exact || p.trace_shadows || p.light_buffers);
    }
  }
  request.lights = {casts_none, casts};
  EXPECT_TRUE(plan(ShadowMode::exact).mark_exact && plan(ShadowMode::exact).light_buffers);
  EXPECT_TRUE(plan(ShadowMode::blur).mark_blur);
  EXPECT_FALSE(plan(ShadowMode::blur).casts_shadow(0));
  EXPECT_TRUE(plan(ShadowMode::blur).casts_shadow(1));
  EXPECT_FALSE(plan(ShadowMode::none).casts_shadow(1));
}

}  // namespace
}  // namespace hybridrt
