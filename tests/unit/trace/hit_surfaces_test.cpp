// Many surfaces at once against surface_at(), leave() and scatter(), to the bit.

#include "core/trace/hit_surfaces.h"

#include <gtest/gtest.h>
#include <hwy/targets.h>

#include "core/trace/scatter.h"
#include "tests/support/textured_scenes.h"
#include "tests/support/trace_scenes.h"

namespace hybridrt {
namespace {

/// Triangles of all kinds of materials that send rays, and of some that do not, with random normals.
Scene many_mirrors_and_glasses(uint32_t seed, int triangles) {
  Random random(seed);
  Scene scene = random_soup(seed, triangles, 0.5f);
  for (int i = 0; i < triangles; ++i) {
    const uint32_t n = static_cast<uint32_t>(scene.normals.size());
    for (int k = 0; k < 3; ++k) scene.normals.push_back(random.direction());
    scene.triangle_normals.push_back({n, n + 1, n + 2});
  }
  for (int i = 0; i < 40; ++i) {
    Material m;
    m.fresnel = static_cast<Fresnel>(random.below(3));
    if (random.below(3) != 0) m.reflect = random.in_cube(0, 1);
    if (random.below(3) != 0) m.transmit = random.in_cube(0, 1);
    m.ni = random.below(4) == 0 ? 1 : random.between(0.5f, 2.5f);
    scene.materials.push_back(m);
  }
  // Neighbours share a material more often than not, as in pictures.
  for (int i = 0; i < triangles; ++i)
    scene.triangle_materials.push_back(i % 32 < 16 ? static_cast<uint32_t>(i / 32 % 40) : random.below(40));
  return scene;
}

HitSurfaces<float> random_hits(const Scene& scene, Random& random, int count) {
  HitSurfaces<float> hits;
  hits.count = count;
  const uint32_t first = random.below(static_cast<uint32_t>(scene.triangle_count()));
  for (int i = 0; i < count; ++i) {
    hits.triangle[i] = (first + static_cast<uint32_t>(i)) % static_cast<uint32_t>(scene.triangle_count());
    const float u = random.unit(), v = random.unit();
    hits.u[i] = std::min(u, 1 - v), hits.v[i] = std::min(v, 1 - u);
    vec3 dir = random.direction();
    if (i % 3 == 0) {  // along the surface, nearly
      const vec3 a = scene.vertex(hits.triangle[i], 0), b = scene.vertex(hits.triangle[i], 1);
      dir = glm::normalize(glm::normalize(b - a) + 1e-3f * random.between(0, 1) * dir);
    }
    for (int k = 0; k < 3; ++k) hits.dir[k][i] = dir[k];
    hits.solid_angle[i] = 1e-5f * random.unit(), hits.distance[i] = random.between(0.1f, 10);
  }
  return hits;
}

vec3 at(const float (&values)[3][HitSurfaces<float>::kRoom], int i) {
  return {values[0][i], values[1][i], values[2][i]};
}

void expect_ray(const LeavingRays<float>& rays, int i, const Ray<float>& ray, const vec3& weight) {
  ASSERT_EQ(at(rays.dir, i), ray.dir);
  ASSERT_EQ(at(rays.origin, i), ray.origin);
  ASSERT_EQ(at(rays.weight, i), weight);
}

/// What the comparisons have met, so that none passes for want of cases.
struct Cases {
  int bent = 0, reflected_totally = 0, schlick = 0, silent = 0;
};

void expect_as_one_by_one(const Scene& scene, const HitSurfaces<float>& hits, const vec3& to_light, Cases& cases) {
  ShadowOrigins<float> shadows;
  leave_toward(hits, to_light, shadows);
  ScatteredFromHits<float> sent;
  scatter_all(scene, hits, sent);
  for (int i = 0; i < hits.count; ++i) {
    const vec3 dir = at(hits.dir, i);
    const Surface<float> s = surface_at(scene, hits.triangle[i], hits.u[i], hits.v[i], dir);
    ASSERT_EQ(at(hits.point, i), s.point);
    ASSERT_EQ(at(hits.side, i), s.side);
    ASSERT_EQ(at(hits.normal, i), s.normal);
    ASSERT_EQ(hits.offset[i], s.offset);
    ASSERT_EQ(hits.from_outside[i] != 0, s.from_outside);
    ASSERT_EQ(hits.material[i], s.material);
    ASSERT_EQ(shadows.facing[i] != 0, glm::dot(s.side, to_light) > 0);
    ASSERT_EQ(at(shadows.origin, i), leave(s, to_light).origin);

    const Material& m = scene.materials[s.material];
    if (!m.reflective() && !m.transmissive()) {
      ++cases.silent;
      continue;
    }
    const Scattered<float> out = scatter(m, reflect_of(scene, hits, i), s, dir);
    expect_ray(sent.reflected, i, leave(s, out.reflected_dir), out.reflected_weight);
    expect_ray(sent.refracted, i, leave(s, out.refracted_dir, false), out.refracted_weight);
    cases.bent += m.bends_light() && out.refracted_dir != dir;
    cases.reflected_totally += m.bends_light() && out.refracted_weight == vec3(0);
    cases.schlick += m.fresnel == Fresnel::schlick;
  }
}

void expect_as_one_by_one_everywhere(const Scene& scene, Cases& cases) {
  for (const int64_t target : hwy::SupportedAndGeneratedTargets()) {
    SCOPED_TRACE(hwy::TargetName(target));
    hwy::SetSupportedTargetsForTest(target);
    hwy::GetChosenTarget().Update(hwy::SupportedTargets());
    Random random(7);
    for (int round = 0; round < 200; ++round) {
      HitSurfaces<float> hits =
          random_hits(scene, random, 1 + static_cast<int>(random.below(HitSurfaces<float>::kMost)));
      find_surfaces(scene, hits);
      expect_as_one_by_one(scene, hits, random.direction(), cases);
    }
  }
  hwy::SetSupportedTargetsForTest(0);
  hwy::GetChosenTarget().Update(hwy::SupportedTargets());
}

TEST(HitSurfaces, AreThoseOfSingleRaysToTheBitUnderEveryInstructionSet) {
  Cases cases;
  expect_as_one_by_one_everywhere(many_mirrors_and_glasses(11, 500), cases);
  EXPECT_GT(cases.bent, 1000);
  EXPECT_GT(cases.reflected_totally, 100);
  EXPECT_GT(cases.schlick, 1000);
  EXPECT_GT(cases.silent, 100);
}

TEST(HitSurfaces, TexturesColourWhatTheyReflect) {
  Cases cases;
  expect_as_one_by_one_everywhere(textured_room(), cases);
}

TEST(HitSurfaces, FarFromTheOriginToo) {
  Cases cases;
  expect_as_one_by_one_everywhere(transformed(many_mirrors_and_glasses(12, 100), 100, vec3(1e6f, -2e6f, 3e5f)), cases);
}

}  // namespace
}  // namespace hybridrt
