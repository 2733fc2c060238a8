// Pass 1's depth and pass 2's shadow test against rays cast in double.

#include "core/passes_gl/shadow_map.h"
#include "core/procedural/spheres.h"
#include "core/trace/surface.h"
#include "shaders/shared.h"
#include "tests/gl/pass_test.h"

namespace hybridrt {
namespace {

constexpr int kMap_px = 256;
constexpr double kSnap_texels = 1.0 / 64;
// Float matrices and interpolation of a depth in 0..1.
constexpr double kDepthError = 4e-6;

struct ShadowMap {
  ShadowMap(const gl::Functions& gl, const SceneGpu& scene, const ShadowMapFit& fit, int size_px)
      : depth(gl, GL_DEPTH_COMPONENT32F, size_px, size_px, "shadow map"), target(gl, nullptr, depth, "shadow map") {
    ShadowMapPass(gl, gl::embedded_shaders()).run({scene, fit, size_px}, {target});
  }
  gl::Texture depth;
  gl::Framebuffer target;
};

class ShadowMapTest : public GlTest {
 protected:
  static double w_at(const ShadowMapFit& fit, double y) { return 1 / (1 + fit.inverse_w_slope * y / kMap_px); }

  /// The nearest surface at a place of the map, in texels; t is (z + 1) / 2.
  static Hit<double> nearest_at(const PrimaryRays& rays, const ShadowMapFit& fit, double x, double y) {
    const dmat4 from_map = glm::inverse(fit.map_from_origin);
    const double w = w_at(fit, y);
    const dvec3 begin(from_map * dvec4(w * x / kMap_px, w * y / kMap_px, -1, w));
    const dvec3 end(from_map * dvec4(w * x / kMap_px, w * y / kMap_px, 1, w));
    return rays.closest({fit.origin + begin, end - begin});
  }

  /// Whether snapping can have moved the surface `hit` to depth `drawn` at a place of the map.
  static bool explains(const Scene& scene, const ShadowMapFit& fit, const Hit<double>& hit, double x, double y,
                       double drawn) {
    if (!hit.found()) return drawn == 1;
    dvec3 p[3];  // texels and what the map holds
    for (int corner = 0; corner < 3; ++corner) {
      const dvec4 q = fit.map_from_origin * dvec4(dvec3(scene.vertex(hit.triangle, corner)) - fit.origin, 1);
      p[corner] = dvec3(q) / q.w * dvec3(kMap_px, kMap_px, 0.5) + dvec3(0, 0, 0.5);
    }
    const dvec3 normal = glm::cross(p[1] - p[0], p[2] - p[0]);
    const double slope_x = -normal.x / normal.z, slope_y = -normal.y / normal.z;
    const double depth = p[0].z + slope_x * (x - p[0].x) + slope_y * (y - p[0].y);
    return std::abs(drawn - depth) <= kDepthError + kSnap_texels * (std::abs(slope_x) + std::abs(slope_y));
  }

  void expect_depth_of_rays(const Scene& scene, const dvec3& toward) {
    expect_depth_of_rays(scene, uniform_shadow_map(fit_light_frame(scene, glm::normalize(toward)), kMap_px));
  }

  void expect_depth_of_rays(const Scene& scene, const ShadowMapFit& fit) {
    const SceneGpu gpu(context(), scene);
    const ShadowMap map(gl(), gpu, fit, kMap_px);
    const auto depth = read_pixels<float>(gl(), map.depth, kMap_px, kMap_px, GL_DEPTH_COMPONENT, GL_FLOAT);
    const PrimaryRays rays(scene);
    int covered = 0, differ = 0, unexplained = 0;
    for (int y = 0; y < kMap_px; ++y)
      for (int x = 0; x < kMap_px; ++x) {
        const double drawn = depth[static_cast<size_t>(y) * kMap_px + x];
        const Hit<double> truth = nearest_at(rays, fit, x + 0.5, y + 0.5);
        covered += truth.found();
        if (std::abs(drawn - (truth.found() ? 0.5 + (truth.t - 0.5) / w_at(fit, y + 0.5) : 1)) <= kDepthError) continue;
        ++differ;
        // Snapping moves outlines: one of the surfaces nearby must be what was drawn.
        bool explained = explains(scene, fit, truth, x + 0.5, y + 0.5, drawn);
        for (int i = 0; i < 16 && !explained; ++i) {
          const double across = kSnap_texels * std::cos(i * kPi / 8), along = kSnap_texels * std::sin(i * kPi / 8);
          const Hit<double> near = nearest_at(rays, fit, x + 0.5 + across, y + 0.5 + along);
          explained = explains(scene, fit, near, x + 0.5, y + 0.5, drawn);
        }
        unexplained += !explained;
      }
    EXPECT_GT(covered, kMap_px * kMap_px / 10);
    EXPECT_EQ(unexplained, 0) << differ << " of " << kMap_px * kMap_px << " differ";
    RecordProperty("differ", differ);
  }
};

TEST_F(ShadowMapTest, DepthOfSpheres) {
  const Scene scene = make_spheres({3000, 0});
  for (const dvec3& toward : {dvec3(0.3, 1, 0.4), dvec3(-1, 0.2, 0.5), dvec3(0, 1, 0), dvec3(0, -1, 0.1)})
    expect_depth_of_rays(scene, toward);
}

TEST_F(ShadowMapTest, DepthOfSoup) { expect_depth_of_rays(with_normals(random_soup(11, 200, 0.5f)), {0.6, 0.5, -0.7}); }

// A flat scene still has some depth, and light along it works.
TEST_F(ShadowMapTest, FlatScene) {
  Scene flat;
  add_triangle(flat, {-1, 0, -1}, {-1, 0, 1}, {1, 0, 1});
  add_triangle(flat, {-1, 0, -1}, {1, 0, 1}, {1, 0, -1});
  expect_depth_of_rays(with_normals(flat), {0, 1, 0});
}

// Within the scene and low over its floor: much of it lies behind the eye, and behind the warp's pole.
TEST_F(ShadowMapTest, WarpedDepth) {
  const Scene scene = make_spheres({3000, 0});
  const dvec3 middle(scene.bounds.center()), size(scene.bounds.extent());
  int warped = 0, behind_pole = 0;
  for (const dvec3& toward : {dvec3(0.3, 1, 0.4), dvec3(-1, 0.2, 0.5), dvec3(0, 1, 0), dvec3(0.2, 0.1, -1)})
    for (const dvec3& forward : {dvec3(1, -0.3, 0.2), dvec3(-0.5, -0.1, 1), dvec3(0, -1, 0.01)}) {
      const dvec3 eye = middle + dvec3(0.1, 0.6, 0.05) * size;
      const View view = make_view({eye, eye + forward, {0, 1, 0}, 0.8}, dvec3(0), 160, 120);
      const SeenScene seen(context(), scene, view, 1e-5);
      const LightFrame light = fit_light_frame(scene, glm::normalize(toward));
      const ShadowMapFit fit = fit_shadow_map(light, view, seen.receivers(1e-5), kMap_px);
      warped += fit.inverse_w_slope < -0.5;
      for (const vec3& p : scene.positions)
        behind_pole += (fit.map_from_origin * dvec4(dvec3(p) - fit.origin, 1)).w < 0;
      expect_depth_of_rays(scene, fit);
    }
  EXPECT_GT(warped, 3);
  EXPECT_GT(behind_pole, 100);
}

struct SeenFrom {
  const char* name;
  bool warped;
  dvec3 toward;
};
class ShadowTest : public ShadowMapTest, public testing::WithParamInterface<SeenFrom> {};

// Where no shadow's edge is near, the map and a ray agree, unless the light nearly grazes a surface: offsets are
// bounded.
TEST_P(ShadowTest, AgreesWithRaysAwayFromEdges) {
  const int width = 400, height = 300, map_px = 2048, reach = 4;
  const double grazing_cos = 0.05;
  const Scene scene = make_spheres({3000, 0});
  const View view = make_view(camera_at_angle(scene, 0.5, 0.6), dvec3(0), width, height);
  const SeenScene seen(context(), scene, view, 1e-5);
  const LightFrame light = fit_light_frame(scene, glm::normalize(GetParam().toward));
  const ShadowMapFit fit =
      GetParam().warped ? fit_shadow_map(light, view, seen.receivers(1e-5), map_px) : uniform_shadow_map(light, map_px);
  const ShadowMap map(gl(), seen.gpu, fit, map_px);
  const gl::Texture mask(gl(), GL_R8UI, width, height, "mask");
  ShadowTestPass(gl(), gl::embedded_shaders()).run({seen.gpu, view, light.toward, fit, seen.ids, map.depth}, {mask});
  const auto tested = read_pixels<uint8_t>(gl(), mask, width, height, GL_RED_INTEGER, GL_UNSIGNED_BYTE);

  const std::vector<uint32_t> ids = seen.read_ids();
  const PrimaryRays rays(scene);
  std::vector<uint8_t> truth(tested.size(), HRT_MASK_NO_RECEIVER);
  std::vector<bool> grazed(tested.size());
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const size_t i = static_cast<size_t>(y) * width + x;
      ASSERT_EQ(tested[i] == HRT_MASK_NO_RECEIVER, ids[i] == kNoTriangle) << x << ' ' << y;
      if (ids[i] == kNoTriangle) continue;
      const dvec3 p0 = scene.vertex(ids[i], 0), dir = view.pixel_dir(x, y);
      dvec3 normal = glm::cross(dvec3(scene.vertex(ids[i], 1)) - p0, dvec3(scene.vertex(ids[i], 2)) - p0);
      normal = turned_toward(glm::normalize(normal), -dir);
      const double t = glm::dot(p0 - view.eye, normal) / glm::dot(dir, normal);
      const double cos_light = glm::dot(normal, light.toward);
      grazed[i] = cos_light > 0 && cos_light < grazing_cos;
      const bool dark = cos_light <= 0 || rays.occluded({view.eye + t * dir + 1e-6 * normal, light.toward});
      truth[i] = dark ? 0 : HRT_MASK_LIT;
    }

  int clear = 0, wrong = 0, lit = 0;
  for (int y = reach; y < height - reach; ++y)
    for (int x = reach; x < width - reach; ++x) {
      const size_t i = static_cast<size_t>(y) * width + x;
      bool same = truth[i] != HRT_MASK_NO_RECEIVER && !grazed[i];
      for (int dy = -reach; dy <= reach && same; ++dy)
        for (int dx = -reach; dx <= reach && same; ++dx)
          same = truth[i + static_cast<size_t>(dy * width + dx)] == truth[i];
      if (!same) continue;
      ++clear;
      lit += truth[i] == HRT_MASK_LIT;
      wrong += tested[i] != truth[i];
    }
  EXPECT_GT(lit, width * height / 50);
  EXPECT_GT(clear - lit, width * height / 100);
  EXPECT_EQ(wrong, 0) << "of " << clear << " pixels away from any edge";
  RecordProperty("wrong", wrong);
}

INSTANTIATE_TEST_SUITE_P(Lights, ShadowTest,
                         testing::Values(SeenFrom{"uniform", false, {-0.5, 1, 0.3}},
                                         SeenFrom{"warped", true, {-0.5, 1, 0.3}},
                                         SeenFrom{"warped_low", true, {-0.5, 0.15, 0.3}},
                                         SeenFrom{"warped_against_the_view", true, {0.5, 0.4, 0.9}},
                                         SeenFrom{"warped_toward_the_view", true, {-0.5, 0.3, -0.9}},
                                         SeenFrom{"warped_zenith", true, {0, 1, 0}}),
                         [](const auto& from) { return from.param.name; });

}  // namespace
}  // namespace hybridrt
