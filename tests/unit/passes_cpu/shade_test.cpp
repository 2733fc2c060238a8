#include "core/passes_cpu/shade.h"

#include <gtest/gtest.h>
#include <hwy/targets.h>

#include "core/trace/surface_at.h"
#include "core/trace/texture_lookup.h"
#include "tests/support/textured_scenes.h"
#include "tests/support/trace_scenes.h"

namespace hybridrt {
namespace {

constexpr int kPoints = 61;

/// A scene of triangles in front of the eye, each of its own material, with random normals.
Scene many_materials() {
  Random random(5);
  Scene scene;
  for (int i = 0; i < kPoints; ++i) {
    const vec3 p = random.in_cube(-1, 1) - vec3(0, 0, 4);
    add_triangle(scene, p, p + random.in_cube(-1, 1), p + random.in_cube(-1, 1));
    const uint32_t n = static_cast<uint32_t>(scene.normals.size());
    for (int k = 0; k < 3; ++k) scene.normals.push_back(random.direction());
    scene.triangle_normals.push_back({n, n + 1, n + 2});
    scene.triangle_materials.push_back(static_cast<uint32_t>(i));
    Material m;
    m.kd = random.in_cube(0, 1), m.ks = random.in_cube(0, 1), m.ke = random.in_cube(0, 0.2f);
    m.ns = i % 5 == 0 ? 0 : std::exp2(10 * random.unit());
    m.opacity = random.unit();
    scene.materials.push_back(m);
  }
  scene.bounds = compute_bounds(scene);
  return scene;
}

SeenPoints points_on(const Scene& scene, const View& view, std::span<const TracedLight> lights) {
  SeenPoints points;
  Random random(6);
  for (int i = 0; i < kPoints; ++i) {
    points.x[i] = static_cast<int>(random.below(view.width_px)),
    points.y[i] = static_cast<int>(random.below(view.height_px));
    points.triangle[i] = random.below(static_cast<uint32_t>(scene.triangle_count()));
  }
  points.count = kPoints;
  find_points(scene, view, lights, points);
  return points;
}

/// One point by the scalar functions.
vec3 shaded_alone(const TraceJob& job, const SeenPoints& p, int i, unsigned lit) {
  const vec3 dir(p.dir[0][i], p.dir[1][i], p.dir[2][i]);
  const Surface<float> surface = surface_at(job.scene, p.triangle[i], p.u[i], p.v[i], dir);
  const Material& m = job.scene.materials[surface.material];
  const SurfaceColors<float> paint = m.texture_maps == 0 ? plain_colors(job.scene, p.triangle[i], p.u[i], p.v[i])
                                                         : textured_colors(job.scene, p.triangle[i], p.u[i], p.v[i],
                                                                           dir, p.solid_angle[i], p.distance[i]);
  vec3 color =
      phong_unlit(paint.kd, paint.ke, m.opacity, ambient_at(job.ambient.color, job.ambient.slope, surface.normal));
  for (size_t l = 0; l < job.lights.size(); ++l)
    if (lit >> l & 1)
      color += phong_light(paint.kd, paint.ks, m.ns, m.opacity, surface.normal, -dir, vec3(job.lights[l].light.toward),
                           job.lights[l].light.color);
  return color;
}

std::vector<TracedLight> two_lights() {
  return {{{glm::normalize(dvec3(1, 2, 3)), vec3(1, 0.8f, 0.5f)}}, {{dvec3(0, 1, 0), vec3(0.3f)}}};
}

/// Highlights are a vector's own series; all else is equal to the bit.
void expect_as_one_by_one(const Scene& scene, const std::vector<TracedLight>& lights = two_lights(),
                          int height_px = 48) {
  Camera camera;
  camera.eye_world = dvec3(0.1, 0.2, 1), camera.target_world = dvec3(0, 0, -4);
  const View view = make_view(camera, dvec3(0), height_px * 4 / 3, height_px);
  TraceJob job{scene, view, lights};
  job.ambient = {vec3(0.2f, 0.1f, 0.3f), vec3(0.1f, 0.5f, 0)};
  const SeenPoints points = points_on(scene, view, job.lights);
  std::vector<uint8_t> lit(points.facing, points.facing + kPoints);
  for (int i = 0; i < kPoints; i += 3) lit[i] = 0;
  static float first_colors[3][SeenPoints::kRoom];
  bool is_first = true;
  for (const int64_t target : hwy::SupportedAndGeneratedTargets()) {
    SCOPED_TRACE(hwy::TargetName(target));
    hwy::SetSupportedTargetsForTest(target);
    hwy::GetChosenTarget().Update(hwy::SupportedTargets());
    static float colors[3][SeenPoints::kRoom];
    shade(job, points, lit, colors);
    for (int i = 0; i < kPoints; ++i) {
      const vec3 expected = shaded_alone(job, points, i, lit[i]);
      for (int k = 0; k < 3; ++k) {
        EXPECT_NEAR(colors[k][i], expected[k], lights.empty() ? 0 : 1e-6f) << "point " << i;
        if (!is_first) {
          EXPECT_EQ(colors[k][i], first_colors[k][i]) << "point " << i;
        }
        first_colors[k][i] = colors[k][i];
      }
    }
    is_first = false;
  }
  hwy::SetSupportedTargetsForTest(0);
  hwy::GetChosenTarget().Update(hwy::SupportedTargets());
}

TEST(ShadeOnCpu, IsTheSameTextPointByPointAndUnderEveryInstructionSet) { expect_as_one_by_one(many_materials()); }

TEST(ShadeOnCpu, TexturesToo) { expect_as_one_by_one(textured_room()); }

// The larger the pixels, the coarser the levels.
TEST(ShadeOnCpu, TexturesAreThoseOfOnePointToTheBit) {
  for (const int height_px : {3, 6, 12, 48, 200}) expect_as_one_by_one(textured_room(), {}, height_px);
}

}  // namespace
}  // namespace hybridrt
