#include <gtest/gtest.h>

#include "core/trace/embree_caster.h"
#include "core/trace/kd_caster.h"
#include "tests/support/trace_scenes.h"

namespace hybridrt {
namespace {

/// Rays from within (or very near) `center` to points exactly on edges and vertices, as far as float allows.
template <typename Real>
std::vector<Ray<Real>> rays_at_edges(const Scene& scene, const vec3& center, float spread, int count) {
  Random random(17);
  std::vector<Ray<Real>> rays;
  for (int i = 0; i < count; ++i) {
    const uint32_t triangle = random.below(static_cast<uint32_t>(scene.triangle_count()));
    const int corner = static_cast<int>(random.below(3));
    const vec3 a = scene.vertex(triangle, corner), b = scene.vertex(triangle, (corner + 1) % 3);
    const float along = i % 4 == 0 ? 0.0f : i % 4 == 1 ? 0.5f : random.unit();
    const vec3 origin = i % 5 == 0 ? center : center + spread * random.in_cube(-1, 1);
    const Vec3<Real> target = Vec3<Real>(a) + Real(along) * (Vec3<Real>(b) - Vec3<Real>(a));
    rays.push_back({Vec3<Real>(origin), target - Vec3<Real>(origin)});
    if (i % 3 == 0) rays.back().dir = glm::normalize(rays.back().dir);
  }
  return rays;
}

/// Rays along the axes from `center` and from points in its planes: the planes of splits and faces.
std::vector<Ray<float>> axis_rays(const Scene& scene, const vec3& center, float spread, int count) {
  Random random(18);
  std::vector<Ray<float>> rays;
  for (int i = 0; i < count; ++i) {
    const int axis = i % 3;
    Ray<float> ray;
    ray.origin = center;
    ray.dir = vec3(i & 1 ? 0.0f : -0.0f);
    ray.dir[axis] = i & 2 ? 1.0f : -1.0f;
    const vec3 vertex = scene.positions[random.below(static_cast<uint32_t>(scene.positions.size()))];
    for (int other = 0; other < 3; ++other) {
      if (other == axis) continue;
      ray.origin[other] += spread * random.between(-1, 1);
      // Through a vertex, where that stays inside.
      if (random.below(2) && std::abs(vertex[other] - center[other]) < spread) ray.origin[other] = vertex[other];
    }
    rays.push_back(ray);
  }
  return rays;
}

template <typename Real>
int count_escapes(const RayCaster<Real>& caster, const std::vector<Ray<Real>>& rays) {
  std::vector<Hit<Real>> hits(rays.size());
  std::vector<uint8_t> occluded(rays.size());
  caster.closest_hits(rays, hits);
  caster.any_hits(rays, occluded);
  int escapes = 0;
  for (size_t i = 0; i < rays.size(); ++i) escapes += !hits[i].found() || !occluded[i];
  return escapes;
}

struct Placed {
  Scene scene;
  vec3 center;
  float spread;  ///< center + [-spread, spread]^3 lies inside
};

std::vector<Placed> closed_scenes() {
  std::vector<Placed> scenes;
  for (const float scale : {1.0f, 1e-4f, 1e6f, 1e-15f, 1e12f})
    for (const vec3& offset : {vec3(0), vec3(0.1f, -3, 7), vec3(1000, 333, -77)}) {
      scenes.push_back({transformed(closed_box(), scale, scale * offset), scale * (vec3(0.5f) + offset), 0.3f * scale});
      scenes.push_back({transformed(closed_sphere(64, 32), scale, scale * offset), scale * offset, 0.3f * scale});
    }
  return scenes;
}

TEST(Watertight, NoRayEscapesFromTheKdTree) {
  ThreadPool pool(2);
  for (const Placed& placed : closed_scenes()) {
    SCOPED_TRACE(testing::Message() << "center " << placed.center.x << " spread " << placed.spread);
    const KdTree tree = build_kd_tree(placed.scene, pool);
    auto rays = rays_at_edges<float>(placed.scene, placed.center, placed.spread, 100000);
    const auto more = axis_rays(placed.scene, placed.center, placed.spread, 10000);
    rays.insert(rays.end(), more.begin(), more.end());
    EXPECT_EQ(count_escapes(*make_kd_caster(tree, LeafKernel::scalar), rays), 0);
    EXPECT_EQ(count_escapes(*make_kd_caster(tree, LeafKernel::simd), rays), 0);
  }
}

TEST(Watertight, NoRayEscapesFromTheReference) {
  ThreadPool pool(2);
  for (const Placed& placed : closed_scenes()) {
    SCOPED_TRACE(testing::Message() << "center " << placed.center.x << " spread " << placed.spread);
    const KdTree tree = build_kd_tree(placed.scene, pool);
    auto rays = rays_at_edges<double>(placed.scene, placed.center, placed.spread, 50000);
    for (const Ray<float>& ray : axis_rays(placed.scene, placed.center, placed.spread, 10000))
      rays.push_back(in_double(ray));
    EXPECT_EQ(count_escapes(*make_reference_caster(tree), rays), 0);
  }
}

// From far outside onto a large closed surface: the shear's rounding is largest against the cells there.
TEST(Watertight, NoRayPassesBetweenTheTrianglesFromFarAway) {
  ThreadPool pool(2);
  const Scene scene = closed_sphere(256, 128);
  const KdTree tree = build_kd_tree(scene, pool);
  Random random(19);
  std::vector<Ray<float>> rays;
  for (int i = 0; i < 100000; ++i) {
    const vec3 origin = random.direction() * random.between(2, 300);
    const vec3 target = scene.positions[random.below(static_cast<uint32_t>(scene.positions.size()))];
    rays.push_back({origin, 0.9f * target - origin});  // well inside the outline
  }
  EXPECT_EQ(count_escapes(*make_kd_caster(tree, LeafKernel::simd), rays), 0);
}

// Embree 3.13.5 lets through about one in 600 rays aimed exactly at a vertex, robust flag or not; recorded here so that
// nobody takes it for the truth.
TEST(Watertight, FewRaysEscapeFromEmbree) {
  const Scene scene = closed_sphere(64, 32);
  const auto rays = rays_at_edges<float>(scene, vec3(0), 0.3f, 50000);
  EXPECT_LE(count_escapes(*make_embree_caster(scene, 1), rays), 50);
}

}  // namespace
}  // namespace hybridrt
