// Where smooth normals and flat facets disagree about the light: the convention of docs/method.md on a ball
// of eight segments, and how many pixels show its facets by it.

#include <gtest/gtest.h>

#include "core/passes_cpu/trace_pass.h"
#include "core/trace/kd_caster.h"
#include "core/trace/primary_surface.h"
#include "shaders/shared.h"
#include "tests/support/trace_scenes.h"

namespace hybridrt {
namespace {

constexpr int kSize_px = 400, kPixels = kSize_px * kSize_px;

/// The coarse ball with the normals of a true ball.
Scene coarse_ball() {
  Scene ball = closed_sphere(8, 4);
  ball.normals = ball.positions;
  ball.triangle_normals = ball.triangle_positions;
  ball.materials.emplace_back();
  ball.triangle_materials.assign(ball.triangle_count(), 0);
  return ball;
}

dvec3 face_normal(const Scene& scene, uint32_t t) {
  const dvec3 a(scene.vertex(t, 0));
  return glm::cross(dvec3(scene.vertex(t, 1)) - a, dvec3(scene.vertex(t, 2)) - a);
}

dvec2 in_pixels(const View& view, const dvec3& point) {
  const dvec3 p = point - view.eye;
  const double depth = glm::dot(p, view.forward);
  return 0.5 * kSize_px *
         (1.0 + dvec2(glm::dot(p, view.right) / (view.tan_half_width * depth),
                      -glm::dot(p, view.up) / (view.tan_half_height * depth)));
}

/// Pixels covered by the part of a triangle where `toward` and the interpolated normal, here the point
/// itself, look the same way: a half-space cuts it off.
double lit_by_normals_px(const Scene& scene, uint32_t t, const View& view, const dvec3& toward) {
  std::vector<dvec2> corners;
  for (int k = 0; k < 3; ++k) {
    const dvec3 a(scene.vertex(t, k)), b(scene.vertex(t, (k + 1) % 3));
    const double at_a = glm::dot(a, toward), at_b = glm::dot(b, toward);
    if (at_a > 0) corners.push_back(in_pixels(view, a));
    if ((at_a > 0) != (at_b > 0)) corners.push_back(in_pixels(view, a + at_a / (at_a - at_b) * (b - a)));
  }
  double doubled = 0;
  for (size_t i = 0; i < corners.size(); ++i) {
    const dvec2 &a = corners[i], &b = corners[(i + 1) % corners.size()];
    doubled += a.x * b.y - a.y * b.x;
  }
  return std::abs(doubled) / 2;
}

/// Pixels that the normals would light and whose facet is turned away: they are black.
double faceted_px(const Scene& scene, const View& view, const dvec3& toward) {
  double sum = 0;
  for (uint32_t t = 0; t < scene.triangle_count(); ++t) {
    const dvec3 normal = face_normal(scene, t);
    if (glm::dot(normal, view.eye - dvec3(scene.vertex(t, 0))) > 0 && glm::dot(normal, toward) <= 0)
      sum += lit_by_normals_px(scene, t, view, toward);
  }
  return sum;
}

class ShadowTerminator : public testing::Test {
 protected:
  struct Seen {
    std::vector<vec4> picture = std::vector<vec4>(kPixels);
    std::vector<uint32_t> ids = std::vector<uint32_t>(kPixels);
    std::vector<uint8_t> lit = std::vector<uint8_t>(kPixels);
    TraceStats stats;
  };

  /// A facet turned away is in shadow, any other facet of a convex body is lit, to the pixel; as many pixels show it as
  /// the geometry says; and only lit ones have asked a ray.
  void expect_convention(const Seen& seen, const View& view, const dvec3& toward) const {
    int faceted = 0, wrong = 0, lit = 0;
    for (int i = 0; i < kPixels; ++i) {
      if (seen.ids[i] == kNoTriangle) continue;
      const bool faces_light = glm::dot(face_normal(scene_, seen.ids[i]), toward) > 0;
      wrong += (seen.lit[i] == HRT_MASK_LIT) != faces_light;
      lit += faces_light;
      const dvec3 dir = glm::normalize(view.pixel_dir(i % kSize_px, i / kSize_px));
      const dvec3 weights = seen_barycentrics(scene_, seen.ids[i], view.eye, dir);
      const auto surface = surface_at(scene_, seen.ids[i], weights.y, weights.z, dir);
      const bool black = vec3(seen.picture[i]) == vec3(0);
      faceted += black && glm::dot(surface.normal, toward) > 0;
    }
    EXPECT_EQ(wrong, 0);
    EXPECT_EQ(seen.stats.primary_shadow_rays, lit);
    const double expected = faceted_px(scene_, view, toward);
    EXPECT_GT(expected, 1000);
    EXPECT_NEAR(faceted, expected, 0.01 * expected);
  }

  template <typename Real>
  Seen trace(const TraceJob& job, const RayCaster<Real>& caster) {
    Seen seen;
    seen.stats = trace_frame(job, caster, pool_, TracedFrame<Real>{seen.picture, seen.ids, seen.lit});
    return seen;
  }

  const Scene scene_ = coarse_ball();
  ThreadPool pool_{1};
  const KdTree tree_ = build_kd_tree(scene_, pool_);
};

TEST_F(ShadowTerminator, FacetsThatTurnAwayAreBlackAndAsManyAsTheGeometrySays) {
  for (const dvec3& light : {dvec3(1, 0.3, 0.4), dvec3(-1, 0.2, -0.7), dvec3(0.6, 0.1, -1)}) {
    SCOPED_TRACE(testing::Message() << light.x << ' ' << light.y);
    const dvec3 toward = glm::normalize(light);
    const View view = make_view({{0.5, 3.5, 1.5}, {0, 0, 0}, {0, 0, 1}, 0.6}, dvec3(0), kSize_px, kSize_px);
    TraceJob job{scene_, view, {{{toward, vec3(1)}}}, true, 0, vec3(0), vec3(0.5f)};
    expect_convention(trace(job, *make_reference_caster(tree_)), view, toward);
    expect_convention(trace(job, *make_kd_caster(tree_, LeafKernel::simd)), view, toward);

    const Sheets sheets = make_sheets(scene_, build_topology(scene_, pool_), pool_);
    const LightBuffer buffer = build_light_buffer(scene_, sheets, toward, pool_);
    job.lights[0].buffer = &buffer;
    expect_convention(trace(job, *make_kd_caster(tree_, LeafKernel::simd)), view, toward);
  }
}

}  // namespace
}  // namespace hybridrt
