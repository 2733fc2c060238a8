// The light at what is seen in mirrors and through glass: a light buffer must answer as the reference traces, also
// where bodies touch, stand in one another, or are turned inside out.

#include <gtest/gtest.h>

#include "core/passes_cpu/trace_pass.h"
#include "core/trace/kd_caster.h"
#include "tests/support/trace_scenes.h"

namespace hybridrt {
namespace {

Material white() { return {}; }

Material clear() {
  Material material;
  material.kd = vec3(0.1f);
  material.opacity = 0.1f;
  resolve_material(material);
  return material;
}

Material mirror() {
  Material material;
  material.kd = vec3(0);
  material.reflect = vec3(0.9f);
  return material;
}

/// Adds triangles with flat normals.
void add(Scene& scene, const Scene& body, const Material& material) {
  for (uint32_t t = 0; t < body.triangle_count(); ++t) {
    const vec3 a = body.vertex(t, 0), b = body.vertex(t, 1), c = body.vertex(t, 2);
    add_triangle(scene, a, b, c);
    scene.triangle_normals.push_back(uvec3(static_cast<uint32_t>(scene.normals.size())));
    scene.normals.push_back(glm::normalize(glm::cross(b - a, c - a)));
    scene.triangle_materials.push_back(static_cast<uint32_t>(scene.materials.size()));
  }
  scene.materials.push_back(material);
  scene.bounds = compute_bounds(scene);
}

Scene box(const vec3& lo, const vec3& hi) {
  Scene body = closed_box();
  for (vec3& p : body.positions) p = lo + p * (hi - lo);
  return body;
}

/// A ball stretched along z whose cross sections are figures of eight: one of its halves is turned inside out.
Scene figure_of_eight() {
  Scene body = closed_sphere(40, 20);
  for (vec3& p : body.positions) {
    p.y = 1.5f * p.x * p.y;
    if (p.x > 0) p.x *= 1.6f, p.y *= 1.6f;
  }
  return body;
}

/// Share of the pixels that are farther than a shadow from the reference.
double share_off(const Scene& scene, const Camera& camera, const dvec3& toward) {
  constexpr int kWidth_px = 128, kHeight_px = 96;
  ThreadPool pool(2);
  const KdTree tree = build_kd_tree(scene, pool);
  const View view = make_view(camera, dvec3(0), kWidth_px, kHeight_px);
  const Sheets sheets = make_sheets(scene, build_topology(scene, pool), pool);
  const LightBuffer buffer = build_light_buffer(scene, sheets, glm::normalize(toward), pool);
  TraceJob job{scene, view, {{{glm::normalize(toward), vec3(0.8f)}}}};
  std::vector<vec4> truth(kWidth_px * kHeight_px), picture(truth.size());
  std::vector<uint32_t> ids(truth.size());
  std::vector<uint8_t> lit(truth.size());
  trace_frame(job, *make_reference_caster(tree), pool, TracedFrame<double>{truth, ids, lit});
  job.lights[0].buffer = &buffer;
  trace_frame(job, *make_kd_caster(tree, LeafKernel::simd), pool, TracedFrame<float>{picture, ids, lit});
  double off = 0;
  for (size_t i = 0; i < truth.size(); ++i) off += glm::length(vec3(truth[i]) - vec3(picture[i])) > 0.03f;
  return off / static_cast<double>(truth.size());
}

TEST(ShadowsBehindRays, InGlassThatTouchesGlass) {
  const Scene a = box({-2, -1, -1}, {0, 1, 1}), b = box({0, -1.2f, -1.2f}, {2, 1.2f, 1.2f});
  for (const bool a_first : {true, false}) {
    Scene scene;
    add(scene, a_first ? a : b, clear());
    add(scene, a_first ? b : a, clear());
    add(scene, box({0.8f, -0.4f, -0.4f}, {1.2f, 0.4f, 0.4f}), white());
    EXPECT_LT(share_off(scene, {{-6, 0.6, 0.5}, {0, 0, 0}, {0, 1, 0}, 0.8}, {-0.5, 1, 0.3}), 1e-3) << a_first;
  }
}

TEST(ShadowsBehindRays, OnTheLobeOfABodyThatIsTurnedInsideOut) {
  Scene scene;
  add(scene, figure_of_eight(), white());
  Scene wall;
  add_triangle(wall, {-4, -3, -4}, {-4, 3, -4}, {-4, 3, 4});
  add_triangle(wall, {-4, -3, -4}, {-4, 3, 4}, {-4, -3, 4});
  add(scene, wall, mirror());
  for (const dvec3& toward : {dvec3(-0.4, 1, 0.6), dvec3(-1, 0.1, 0.8)})
    EXPECT_LT(share_off(scene, {{-2.5, 0.9, 2.2}, {-4, 0.62, 1.53}, {0, 1, 0}, 0.6}, toward), 2e-3);
}

}  // namespace
}  // namespace hybridrt
