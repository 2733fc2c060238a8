// Many hits shaded at once against the same text one by one.

#include "core/trace/hit_shading.h"

#include <gtest/gtest.h>
#include <hwy/targets.h>

#include "tests/support/textured_scenes.h"
#include "tests/support/trace_scenes.h"

namespace hybridrt {
namespace {

constexpr int kHits = 61;

Scene many_colors() {
  Random random(21);
  Scene scene = random_soup(22, 200, 0.5f);
  for (uint32_t i = 0; i < scene.triangle_count(); ++i) {
    scene.triangle_materials.push_back(i % 32 < 16 ? i / 32 : 7 + random.below(20));  // neighbours are often alike
    for (int k = 0; k < 3; ++k) scene.normals.push_back(random.direction());
    scene.triangle_normals.push_back(uvec3(3 * i, 3 * i + 1, 3 * i + 2));
    scene.triangle_colors.push_back(uvec3(i % 5, i % 3, i % 2));
  }
  for (int i = 0; i < 27; ++i) {
    Material m;
    m.kd = random.in_cube(0, 1), m.ks = random.in_cube(0, 1), m.ke = random.in_cube(0, 0.2f);
    m.ns = i % 5 == 0 ? 0 : std::exp2(10 * random.unit());
    m.opacity = random.unit();
    scene.materials.push_back(m);
  }
  for (int i = 0; i < 5; ++i) scene.colors.push_back(random.in_cube(0, 1));
  return scene;
}

HitSurfaces<float> hits_on(const Scene& scene) {
  Random random(23);
  HitSurfaces<float> hits;
  hits.count = kHits;
  for (int i = 0; i < kHits; ++i) {
    hits.triangle[i] = (40 + static_cast<uint32_t>(i)) % static_cast<uint32_t>(scene.triangle_count());
    hits.u[i] = 0.5f * random.unit(), hits.v[i] = 0.5f * random.unit();
    const vec3 dir = random.direction();
    for (int k = 0; k < 3; ++k) hits.dir[k][i] = dir[k];
    hits.solid_angle[i] = 1e-4f * random.unit(), hits.distance[i] = random.between(0.1f, 5);
  }
  find_surfaces(scene, hits);
  return hits;
}

vec3 shaded_alone(const TraceJob& job, const HitSurfaces<float>& hits, int i, unsigned lit) {
  const Surface<float> surface = hits.surface(i);
  const Material& m = job.scene.materials[surface.material];
  const SurfaceColors<float> paint = m.texture_maps == 0
                                         ? plain_colors(job.scene, hits.triangle[i], hits.u[i], hits.v[i])
                                         : textured_colors(job.scene, hits.triangle[i], hits.u[i], hits.v[i],
                                                           hits.dir_of(i), hits.solid_angle[i], hits.distance[i]);
  vec3 color =
      phong_unlit(paint.kd, paint.ke, m.opacity, ambient_at(job.ambient.color, job.ambient.slope, surface.normal));
  for (size_t l = 0; l < job.lights.size(); ++l)
    if (lit >> l & 1)
      color += phong_light(paint.kd, paint.ks, m.ns, m.opacity, surface.normal, -hits.dir_of(i),
                           vec3(job.lights[l].light.toward), job.lights[l].light.color);
  return color;
}

/// Highlights are a vector's own series; all else is equal to the bit.
void expect_as_one_by_one(const Scene& scene, bool with_lights) {
  const View view = make_view(Camera(), dvec3(0), 4, 3);
  TraceJob job{scene, view, {}};
  if (with_lights)
    job.lights = {{{glm::normalize(dvec3(1, 2, 3)), vec3(1, 0.8f, 0.5f)}}, {{dvec3(0, 1, 0), vec3(0.3f)}}};
  job.ambient = {vec3(0.2f, 0.1f, 0.3f), vec3(0.1f, 0.5f, 0)};
  const HitSurfaces<float> hits = hits_on(scene);
  uint8_t lit[kHits];
  for (int i = 0; i < kHits; ++i) lit[i] = static_cast<uint8_t>(i % 4);
  std::vector<vec3> first_colors;
  for (const int64_t target : hwy::SupportedAndGeneratedTargets()) {
    SCOPED_TRACE(hwy::TargetName(target));
    hwy::SetSupportedTargetsForTest(target);
    hwy::GetChosenTarget().Update(hwy::SupportedTargets());
    float colors[3][HitSurfaces<float>::kRoom];
    shade_hits(job, hits, lit, colors);
    std::vector<vec3> found;
    for (int i = 0; i < kHits; ++i) {
      found.emplace_back(colors[0][i], colors[1][i], colors[2][i]);
      const vec3 expected = shaded_alone(job, hits, i, lit[i]);
      for (int k = 0; k < 3; ++k) EXPECT_NEAR(found[i][k], expected[k], with_lights ? 1e-6f : 0) << i;
    }
    if (first_colors.empty()) first_colors = found;
    EXPECT_EQ(found, first_colors);
  }
  hwy::SetSupportedTargetsForTest(0);
  hwy::GetChosenTarget().Update(hwy::SupportedTargets());
}

TEST(HitShading, IsThatOfSingleHitsUnderEveryInstructionSet) {
  for (const bool with_lights : {false, true}) {
    expect_as_one_by_one(many_colors(), with_lights);
    expect_as_one_by_one(textured_room(), with_lights);
  }
}

}  // namespace
}  // namespace hybridrt
