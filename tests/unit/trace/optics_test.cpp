// Glass whose rays are known on paper, followed in double precision from surface to surface.

#include <gtest/gtest.h>

#include "core/trace/kd_caster.h"
#include "core/trace/scatter.h"
#include "tests/support/trace_scenes.h"

namespace hybridrt {
namespace {

/// `scene` as glass; its normals are the faces' own, or point away from 0.
Scene as_glass(Scene scene, float ni, bool smooth) {
  scene.normals.clear();
  scene.triangle_normals.clear();
  for (uint32_t t = 0; t < scene.triangle_count(); ++t) {
    const uint32_t first = static_cast<uint32_t>(scene.normals.size());
    const vec3 face = glm::cross(scene.vertex(t, 1) - scene.vertex(t, 0), scene.vertex(t, 2) - scene.vertex(t, 0));
    for (int k = 0; k < 3; ++k) scene.normals.push_back(glm::normalize(smooth ? scene.vertex(t, k) : face));
    scene.triangle_normals.push_back({first, first + 1, first + 2});
  }
  Material glass;
  glass.kd = vec3(0);
  glass.transmit = vec3(1);
  glass.ni = ni;
  glass.fresnel = Fresnel::dielectric;
  scene.materials = {glass};
  scene.triangle_materials.assign(scene.triangle_count(), 0);
  return scene;
}

/// A box with corners at `lo` and `hi`.
Scene block(const vec3& lo, const vec3& hi) {
  Scene scene = closed_box();
  for (vec3& p : scene.positions) p = lo + p * (hi - lo);
  scene.bounds = compute_bounds(scene);
  return scene;
}

/// A prism along z over the triangle (0,0), (1,0), (0,1), wound outward.
Scene right_angled_prism() {
  Scene scene;
  for (float z : {-1.0f, 1.0f}) scene.positions.insert(scene.positions.end(), {{0, 0, z}, {1, 0, z}, {0, 1, z}});
  scene.triangle_positions = {{0, 2, 1}, {3, 4, 5}, {0, 1, 4}, {0, 4, 3}, {1, 2, 5}, {1, 5, 4}, {2, 0, 3}, {2, 3, 5}};
  scene.bounds = compute_bounds(scene);
  return scene;
}

struct Path {
  Ray<double> ray;  ///< as it left the last surface
  double weight = 1;
  int reflected = 0, refracted = 0;
  bool out = false;  ///< it meets nothing more
};

class GlassBody {
 public:
  explicit GlassBody(Scene scene) : scene_(std::move(scene)) {}

  /// Goes through every surface, or back where nothing passes, as ray_generations.cpp does.
  Path follow(const Ray<double>& start, int most_surfaces = 20) const {
    Path path{start};
    while (path.reflected + path.refracted < most_surfaces) {
      Hit<double> hit;
      caster_->closest_hits({&path.ray, 1}, {&hit, 1});
      path.out = !hit.found();
      if (path.out) break;
      const auto surface = surface_at(scene_, hit.triangle, hit.u, hit.v, path.ray.dir);
      const auto on = scatter(scene_.materials[0], surface, path.ray.dir);
      const bool mirrored = on.refracted_weight.x == 0;
      path.ray = mirrored ? leave(surface, on.reflected_dir) : leave(surface, on.refracted_dir, false);
      path.weight *= mirrored ? on.reflected_weight.x : on.refracted_weight.x;
      ++(mirrored ? path.reflected : path.refracted);
    }
    return path;
  }

 private:
  Scene scene_;
  ThreadPool pool_{1};
  KdTree tree_ = build_kd_tree(scene_, pool_);
  std::unique_ptr<RayCaster<double>> caster_ = make_reference_caster(tree_);
};

// A plane-parallel slab shifts a ray by d sin a (1 - cos a / (n cos b)) and leaves its direction.
TEST(Optics, SlabShiftsByTheBookFormula) {
  const double thickness = 2;
  for (const float n : {1.25f, 1.5f, 2.5f}) {
    const GlassBody slab(as_glass(block({-64, -2, -64}, {64, 0, 64}), n, false));
    for (const double a_deg : {0.0, 1.0, 15.0, 30.0, 45.0, 60.0, 75.0, 85.0}) {
      const double a = a_deg * kPi / 180, b = std::asin(std::sin(a) / n);
      const dvec3 dir(std::sin(a) * 0.8, -std::cos(a), std::sin(a) * 0.6), start = dvec3(0.123, 0, 0.456) - dir;
      const Path path = slab.follow({start, dir});
      ASSERT_TRUE(path.out && path.refracted == 2 && path.reflected == 0) << n << ' ' << a_deg;
      EXPECT_LT(glm::distance(path.ray.dir, dir), 1e-12) << n << ' ' << a_deg;
      const double shift = glm::length(glm::cross(path.ray.origin - start, dir));
      EXPECT_NEAR(shift, thickness * std::sin(a) * (1 - std::cos(a) / (n * std::cos(b))), 1e-9) << n << ' ' << a_deg;
      const double mirrored = fresnel_dielectric(std::cos(a), std::cos(b), 1 / double(n));
      EXPECT_NEAR(path.weight, (1 - mirrored) * (1 - mirrored), 1e-12) << "both faces reflect the same share";
    }
  }
}

// A ball bends a ray that passes its middle at distance h by 2 (a - b), sin a = h / R, sin b = h / (n R),
// toward a point R sin a / sin 2(a - b) behind the middle: for small h the focus, f = n R / (2 (n - 1)).
TEST(Optics, BallLensHasTheBooksFocus) {
  for (const float n : {1.5f, 1.75f, 2.5f}) {
    const GlassBody ball(as_glass(closed_sphere(256, 128), n, true));
    for (const double h : {0.02, 0.05, 0.1, 0.3}) {
      const double a = std::asin(h), b = std::asin(h / n), expected = h / std::sin(2 * (a - b));
      double sum = 0;
      constexpr int kRays = 24;
      for (int i = 0; i < kRays; ++i) {
        const double phi = 2 * kPi * (i + 0.3) / kRays;
        const dvec3 away(0, std::cos(phi), std::sin(phi));
        const Path path = ball.follow({dvec3(-3, 0, 0) + h * away, dvec3(1, 0, 0)});
        ASSERT_TRUE(path.out && path.refracted == 2);
        // Where the ray is nearest to the axis.
        const dvec2 off_axis(path.ray.origin.y, path.ray.origin.z), slope(path.ray.dir.y, path.ray.dir.z);
        sum += path.ray.origin.x - path.ray.dir.x * glm::dot(off_axis, slope) / glm::dot(slope, slope);
      }
      EXPECT_NEAR(sum / kRays, expected, 2e-3 * expected) << n << ' ' << h;
      if (h < 0.05) {
        EXPECT_NEAR(sum / kRays, n / (2 * (n - 1.0)), 4e-3 * expected) << "the focus, n = " << n;
      }
    }
  }
}

// Light that enters the long side of a right-angled prism straight on is sent back by its two short sides, at
// 45 degrees past the critical angle; only entering and leaving cost light.
TEST(Optics, PrismSendsAllLightBack) {
  const GlassBody prism(as_glass(right_angled_prism(), 1.5f, false));
  const dvec3 dir = glm::normalize(dvec3(-1, -1, 0));
  const Path path = prism.follow({dvec3(1.3, 1.1, 0.2), dir});
  EXPECT_TRUE(path.out);
  EXPECT_EQ(path.reflected, 2);
  EXPECT_EQ(path.refracted, 2);
  EXPECT_LT(glm::distance(path.ray.dir, -dir), 1e-12);
  EXPECT_NEAR(path.weight, 0.96 * 0.96, 1e-12);
}

// Past the critical angle (41.8 degrees for n = 1.5) at the long sides, and then at the ends too: light stays
// in a block for good and loses nothing. Within it, some leaves at the first bounce.
TEST(Optics, TrappedLightKeepsAllItsWeight) {
  const GlassBody block_of_glass(as_glass(block({-8, -1, -8}, {8, 0, 8}), 1.5f, false));
  for (const double beyond : {1e-6, 1e-9}) {
    const double a = std::asin(1 / 1.5) + beyond;
    const Path path = block_of_glass.follow({dvec3(-7.5, -0.5, 0.1), dvec3(std::sin(a), std::cos(a), 0)}, 500);
    EXPECT_EQ(path.reflected, 500);
    EXPECT_EQ(path.weight, 1);
  }
  const double a = std::asin(1 / 1.5) - 1e-4;
  EXPECT_EQ(block_of_glass.follow({dvec3(-7.5, -0.5, 0.1), dvec3(std::sin(a), std::cos(a), 0)}, 1).refracted, 1);
}

}  // namespace
}  // namespace hybridrt
