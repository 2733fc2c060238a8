#include "core/procedural/spheres.h"

#include <map>

#include "core/load/obj_writer.h"
#include "core/load/scene_source.h"
#include "tests/support/obj_test.h"

namespace hybridrt {
namespace {

int mirrors_of(const SpheresPlan& plan) {
  return static_cast<int>(std::count(plan.is_mirror.begin(), plan.is_mirror.end(), 1));
}

TEST(Spheres, MeetTheCountWithinTwoPercent) {
  for (double wanted = 100; wanted <= 20e6; wanted *= 1.037) {
    const SpheresPlan plan = plan_spheres({static_cast<int64_t>(wanted), 10});
    ASSERT_NEAR(static_cast<double>(plan.triangles()), wanted, 0.02 * wanted);
    ASSERT_GE(plan.rings, 3);
    ASSERT_GE(plan.segments, 4);
    ASSERT_GE(plan.ground_x * plan.ground_z, 4);
  }
  EXPECT_EQ(plan_spheres({}).side, 10);
  EXPECT_EQ(make_spheres({3000, 50}).triangle_count(), static_cast<size_t>(plan_spheres({3000, 50}).triangles()));
}

TEST(Spheres, MirrorsAreNested) {
  SpheresPlan before = plan_spheres({500'000, 0});
  EXPECT_EQ(mirrors_of(before), 0);
  for (double percent = 0.25; percent <= 100; percent += 0.25) {
    const SpheresPlan plan = plan_spheres({500'000, percent});
    EXPECT_EQ(mirrors_of(plan), std::max(1l, std::lround(percent)));
    for (int ball = 0; ball < plan.balls(); ++ball) EXPECT_LE(before.is_mirror[ball], plan.is_mirror[ball]);
    before = plan;
  }
  EXPECT_EQ(mirrors_of(before), before.balls());
}

TEST(Spheres, MirrorMaterialsMirrorAndOthersDoNot) {
  const Scene scene = make_spheres({50'000, 30});
  const SpheresPlan plan = plan_spheres({50'000, 30});
  const auto ground = static_cast<uint32_t>(2 * plan.ground_x * plan.ground_z);
  for (int ball = 0; ball < plan.balls(); ++ball) {
    const Material& m = scene.material_of(ground + static_cast<uint32_t>(ball * plan.ball_triangles()));
    EXPECT_EQ(m.reflective(), plan.is_mirror[ball] != 0);
    if (m.reflective()) {
      EXPECT_EQ(m.reflect, vec3(0.5f));
    }
    EXPECT_NE(m.kd, vec3(0));
  }
}

TEST(Spheres, BallsAreClosedAndFaceOutward) {
  for (const int64_t triangles : {100, 1000, 30'000}) {
    const Scene scene = make_spheres({triangles, 10});
    const SpheresPlan plan = plan_spheres({triangles, 10});
    const auto ground = static_cast<uint32_t>(2 * plan.ground_x * plan.ground_z);
    std::map<std::pair<uint32_t, uint32_t>, int> edges;
    for (uint32_t t = 0; t < scene.triangle_count(); ++t) {
      const vec3 a = scene.vertex(t, 0), face = glm::cross(scene.vertex(t, 1) - a, scene.vertex(t, 2) - a);
      for (int k = 0; k < 3; ++k) {
        EXPECT_GT(glm::dot(face, scene.normals[scene.triangle_normals[t][k]]), 0);
        const uvec3 p = scene.triangle_positions[t];
        if (t >= ground) ++edges[{p[k], p[(k + 1) % 3]}];
      }
      EXPECT_EQ(t < ground, scene.triangle_materials[t] == 0);
    }
    for (const auto& [edge, count] : edges) {
      EXPECT_EQ(count, 1) << "each direction once";
      EXPECT_TRUE(edges.contains({edge.second, edge.first}));
    }
    EXPECT_EQ(scene.bounds.lo.y, 0);
  }
}

}  // namespace
}  // namespace hybridrt
