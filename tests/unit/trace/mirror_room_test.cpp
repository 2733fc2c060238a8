// Generations of rays in scenes whose pictures are known on paper.

#include <gtest/gtest.h>

#include "core/passes_cpu/trace_pass.h"
#include "core/trace/kd_caster.h"
#include "tests/support/trace_scenes.h"

namespace hybridrt {
namespace {

/// A rectangle of two triangles with normals and a material of its own.
void add_wall(Scene& scene, const vec3& corner, const vec3& a, const vec3& b, const Material& material) {
  const uint32_t normal = static_cast<uint32_t>(scene.normals.size());
  scene.normals.push_back(glm::normalize(glm::cross(a, b)));
  add_triangle(scene, corner, corner + a, corner + a + b);
  add_triangle(scene, corner, corner + a + b, corner + b);
  for (int i = 0; i < 2; ++i) {
    scene.triangle_normals.push_back(uvec3(normal));
    scene.triangle_materials.push_back(static_cast<uint32_t>(scene.materials.size()));
  }
  scene.materials.push_back(material);
}

Material glowing(const vec3& color) {
  Material m;
  m.kd = vec3(0);
  m.ke = color;
  return m;
}

Material mirror(float share) {
  Material m;
  m.kd = vec3(0);
  m.reflect = vec3(share);
  return m;
}

template <typename Real>
std::unique_ptr<RayCaster<Real>> make_caster(const KdTree& tree) {
  if constexpr (std::is_same_v<Real, double>)
    return make_reference_caster(tree);
  else
    return make_kd_caster(tree, LeafKernel::simd);
}

template <typename Real>
struct Traced {
  std::vector<vec4> picture;
  std::vector<uint32_t> ids;
  std::vector<uint8_t> lit;
  TraceStats stats;

  Traced(const Scene& scene, const Camera& camera, int width, int height, int depth, int threads = 1,
         bool shadows = false)
      : picture(static_cast<size_t>(width) * height), ids(picture.size()), lit(picture.size()) {
    ThreadPool pool(threads);
    const KdTree tree = build_kd_tree(scene, pool);
    const View view = make_view(camera, dvec3(0), width, height);
    const auto caster = make_caster<Real>(tree);
    const DirectionalLight light{glm::normalize(dvec3(1, 2, 3)), vec3(1)};
    const TraceJob job{scene, view, {{light}}, shadows, depth, vec3(0), vec3(0.25f)};
    stats = trace_frame(job, *caster, pool, TracedFrame<Real>{picture, ids, lit});
  }
};

template <typename Real>
class MirrorRoom : public testing::Test {
 protected:
  /// Two facing mirrors at x = 0 and x = 4 and a small lamp between them, which is behind the camera.
  static Scene facing_mirrors(float share) {
    Scene scene;
    add_wall(scene, {0, -50, -50}, {0, 100, 0}, {0, 0, 100}, mirror(share));
    add_wall(scene, {4, -50, -50}, {0, 0, 100}, {0, 100, 0}, mirror(share));
    add_wall(scene, {1, -0.02f, -0.02f}, {0, 0, 0.04f}, {0, 0.04f, 0}, glowing(vec3(1)));
    scene.bounds = compute_bounds(scene);
    return scene;
  }
};
using Reals = testing::Types<float, double>;
TYPED_TEST_SUITE(MirrorRoom, Reals);

// The lamp at x = 1, seen from x = 2 toward +x in the mirror at 4, stands at 7 = 2 * 4 - 1; its image in the mirror at
// 0, seen again in the mirror at 4, at 8 + 1 = 9, and so on: 15, 17, 23 …, each dimmer by one bounce. Looking a little
// past the nearer images shows the farther ones.
TYPED_TEST(MirrorRoom, ImagesStandWhereTheyMust) {
  struct Image {
    double x;
    int bounces;
  };
  const Scene scene = TestFixture::facing_mirrors(0.5f);
  for (const Image& image : {Image{7, 1}, Image{9, 2}, Image{15, 3}, Image{17, 4}}) {
    // From slightly below the axis, aimed at the image's middle: the images lie at different heights in view.
    const dvec3 eye(2, -0.5, 0), lamp(image.x, 0, 0);
    const Traced<TypeParam> seen(scene, {eye, lamp, {0, 1, 0}, 0.001}, 1, 1, image.bounces);
    EXPECT_NEAR(seen.picture[0].x, std::pow(0.5, image.bounces), 1e-6) << "image at " << image.x;
    EXPECT_EQ(seen.stats.reflection_rays, image.bounces);
    const Traced<TypeParam> too_short(scene, {eye, lamp, {0, 1, 0}, 0.001}, 1, 1, image.bounces - 1);
    EXPECT_NEAR(too_short.picture[0].x, 0, 1e-6) << "one generation less does not reach it";
  }
}

TYPED_TEST(MirrorRoom, DepthZeroFiresNoSecondaryRay) {
  const Traced<TypeParam> seen(TestFixture::facing_mirrors(0.5f), {{2, 0, 0}, {3, 0, 0}, {0, 1, 0}, 1}, 16, 16, 0);
  EXPECT_EQ(seen.stats.reflection_rays, 0);
  EXPECT_EQ(seen.stats.refraction_rays, 0);
  EXPECT_EQ(seen.stats.pixels_hit, 256);
}

// Between perfect mirrors a ray ends at the given depth; between dim ones where its weight is less than 1/1024: 2^-10
// is not, 2^-11 is.
TYPED_TEST(MirrorRoom, RaysEndAtTheirDepthOrWeight) {
  const Camera camera{{2, 20, 20}, {3, 20, 20}, {0, 1, 0}, 0.001};
  EXPECT_EQ(Traced<TypeParam>(TestFixture::facing_mirrors(1), camera, 1, 1, 64).stats.reflection_rays, 64);
  const int64_t fired = Traced<TypeParam>(TestFixture::facing_mirrors(0.5f), camera, 1, 1, 64).stats.reflection_rays;
  EXPECT_EQ(fired, 10);
  EXPECT_EQ(Traced<TypeParam>(TestFixture::facing_mirrors(0.03f), camera, 1, 1, 64).stats.reflection_rays, 1);
  EXPECT_EQ(Traced<TypeParam>(TestFixture::facing_mirrors(0.0009f), camera, 1, 1, 64).stats.reflection_rays, 0);
}

// A pane with Ni = 1 lets (1 - d) of what is behind it through, straight on; two panes, the square of it.
TYPED_TEST(MirrorRoom, ClearPanesLetLightThrough) {
  Material pane;
  pane.kd = vec3(0);
  pane.transmit = vec3(0.5f, 0.25f, 1);
  for (int panes : {1, 2, 3}) {
    Scene scene;
    for (int i = 0; i < panes; ++i) add_wall(scene, {-1, -1, -1.0f - i}, {2, 0, 0}, {0, 2, 0}, pane);
    add_wall(scene, {-9, -9, -10}, {18, 0, 0}, {0, 18, 0}, glowing({0.8f, 0.8f, 0.4f}));
    scene.bounds = compute_bounds(scene);
    const Traced<TypeParam> seen(scene, {{0.1, 0.2, 1}, {0, 0, -10}, {0, 1, 0}, 0.001}, 1, 1, 8);
    EXPECT_NEAR(seen.picture[0].x, 0.8 * std::pow(0.5, panes), 1e-6);
    EXPECT_NEAR(seen.picture[0].y, 0.8 * std::pow(0.25, panes), 1e-6);
    EXPECT_NEAR(seen.picture[0].z, 0.4, 1e-6);
    EXPECT_EQ(seen.stats.refraction_rays, panes);
    EXPECT_EQ(seen.stats.pixels_refractive, 1);
  }
}

// A thick pane shifts what lies behind it sideways by d * (tan a - tan b), and dims it by what its two faces
// reflect.
TYPED_TEST(MirrorRoom, ThickPaneShiftsByTheBookFormula) {
  Material glass;
  glass.kd = vec3(0);
  glass.transmit = vec3(1);
  glass.ni = 1.5f;
  glass.fresnel = Fresnel::dielectric;
  const double sine = 0.6, tan_in = sine / 0.8, inside = sine / 1.5, tan_out = inside / std::sqrt(1 - inside * inside);
  const double thickness = 2, shift = thickness * (tan_in - tan_out);
  // Straight on the ray would meet the wall at z = -5 at x = 5 tan_in + 1 tan_in (it starts at z = 1).
  const double x_hit = 6 * tan_in - shift;
  Scene scene;
  add_wall(scene, {-50, -50, 0}, {100, 0, 0}, {0, 100, 0}, glass);                  // faces +z
  add_wall(scene, {-50, -50, -float(thickness)}, {0, 100, 0}, {100, 0, 0}, glass);  // faces -z
  const float w = 0.01f;
  add_wall(scene, {float(x_hit) - w, -w, -5}, {2 * w, 0, 0}, {0, 2 * w, 0}, glowing(vec3(1)));
  scene.bounds = compute_bounds(scene);
  const Traced<TypeParam> seen(scene, {{0, 0, 1}, {sine, 0, 0.2}, {0, 1, 0}, 1e-5}, 1, 1, 2);
  const double cos_in = 0.8, cos_out = std::sqrt(1 - inside * inside);
  const double parallel = (cos_in - cos_out / 1.5) / (cos_in + cos_out / 1.5);
  const double perpendicular = (cos_in / 1.5 - cos_out) / (cos_in / 1.5 + cos_out);
  const double through = 1 - 0.5 * (parallel * parallel + perpendicular * perpendicular);
  const double mirrored = (1 - through) * 0.25;  // the front face shows the background
  EXPECT_NEAR(seen.picture[0].x, through * through + mirrored, 2e-5);
}

TYPED_TEST(MirrorRoom, ThreadsChangeNoBit) {
  const Camera camera{{2, 1, 3}, {3.5, 0.2, -1}, {0, 1, 0}, 1.2};
  const Scene scene = TestFixture::facing_mirrors(0.7f);
  const Traced<TypeParam> one(scene, camera, 101, 67, 12, 1, true);
  for (int threads : {2, 5}) {
    const Traced<TypeParam> many(scene, camera, 101, 67, 12, threads, true);
    EXPECT_TRUE(one.picture == many.picture);
    EXPECT_EQ(one.ids, many.ids);
    EXPECT_EQ(one.lit, many.lit);
    EXPECT_EQ(one.stats.reflection_rays, many.stats.reflection_rays);
    EXPECT_EQ(one.stats.shadow_rays, many.stats.shadow_rays);
  }
}

}  // namespace
}  // namespace hybridrt
