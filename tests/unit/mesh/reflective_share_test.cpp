// --reflection-percent: how much becomes a mirror, that it is connected, nested, and that nothing else changes.

#include "core/mesh/reflective_share.h"

#include <gtest/gtest.h>
#include <numeric>

#include "core/procedural/procedural.h"
#include "tests/support/topology_scenes.h"

namespace hybridrt {
namespace {

size_t mirrors_in(const Scene& scene) {
  size_t count = 0;
  for (size_t t = 0; t < scene.triangle_count(); ++t)
    count += scene.material_of(static_cast<uint32_t>(t)).reflect == vec3(0.5f);
  return count;
}

double percent_of(const Scene& scene) { return 100.0 * mirrors_in(scene) / scene.triangle_count(); }

Scene procedural(const char* name, int64_t triangles) {
  return find_procedural(name)->make({{"triangles", static_cast<double>(triangles)}});
}

/// The scene with that share, by the topology of the one that it came from.
Scene with_share(Scene scene, double percent) {
  set_reflective_share(scene, topology_of(scene), percent);
  return scene;
}

TEST(ReflectiveShare, IsWithinHalfAPercentOfWhatIsAsked) {
  for (const char* name : {"chess", "spheres", "thin"})
    for (int percent = 0; percent <= 100; percent += 5)
      EXPECT_NEAR(percent_of(with_share(procedural(name, 20'000), percent)), percent, 0.51) << name;
  for (int percent = 0; percent <= 100; percent += 7)  // one body
    EXPECT_NEAR(percent_of(with_share(sphere_scene(40, 61), percent)), percent, 0.51);
}

TEST(ReflectiveShare, NoneAndAllAreExact) {
  const Scene made = procedural("chess", 20'000);
  EXPECT_EQ(mirrors_in(with_share(made, 0)), 0u);
  EXPECT_EQ(mirrors_in(with_share(made, 100)), made.triangle_count());
  EXPECT_EQ(mirrors_in(with_share(cube_scene(), 100)), 12u);
  EXPECT_EQ(mirrors_in(with_share(cube_scene(), 0)), 0u);
}

TEST(ReflectiveShare, AMirrorStaysOneAtAHigherPercentage) {
  for (const Scene& made : {procedural("thin", 10'000), procedural("spheres", 5'000), sphere_scene(30, 41)}) {
    Scene less = with_share(made, 0);
    for (int percent = 1; percent <= 100; ++percent) {
      const Scene more = with_share(made, percent);
      for (uint32_t t = 0; t < made.triangle_count(); ++t)
        ASSERT_TRUE(!less.material_of(t).reflective() || more.material_of(t).reflective() ||
                    less.material_of(t).transmissive())
            << "triangle " << t << " at " << percent;
      less = more;
    }
  }
}

TEST(ReflectiveShare, ALargeBodyTurnsByConnectedPatches) {
  const Scene made = sphere_scene(100, 101);
  const Topology topology = topology_of(made);
  const Scene half = with_share(made, 50);
  // Few edges part mirrors from the rest: a scattered choice would part two thirds of them.
  size_t parted = 0;
  for (size_t e = 0; e < topology.edges.size(); ++e) {
    const auto uses = topology.uses_of(e);
    parted += half.material_of(uses[0].triangle).reflective() != half.material_of(uses[1].triangle).reflective();
  }
  EXPECT_GT(parted, 0u);
  EXPECT_LT(parted, topology.edges.size() / 8);
}

TEST(ReflectiveShare, SmallComponentsStayWhole) {
  const Scene made = procedural("spheres", 20'000);
  const Topology topology = topology_of(made);
  const Scene half = with_share(made, 50);
  std::vector<int> state(topology.components.size(), -1);
  for (uint32_t t = 0; t < made.triangle_count(); ++t) {
    const uint32_t c = topology.component_of_triangle[t];
    if (topology.components[c].triangles > made.triangle_count() / 100) continue;
    const int is_mirror = half.material_of(t).reflect == vec3(0.5f);
    if (state[c] < 0) state[c] = is_mirror;
    ASSERT_EQ(state[c], is_mirror) << "component " << c;
  }
}

TEST(ReflectiveShare, KeepsColoursAndShape) {
  const Scene made = procedural("chess", 20'000);
  const Scene half = with_share(made, 50);
  EXPECT_EQ(half.triangle_positions, made.triangle_positions);
  for (uint32_t t = 0; t < made.triangle_count(); ++t) {
    EXPECT_EQ(half.material_of(t).kd, made.material_of(t).kd);
    EXPECT_EQ(half.material_of(t).ks, made.material_of(t).ks);
    EXPECT_EQ(half.material_of(t).ns, made.material_of(t).ns);
  }
}

TEST(ReflectiveShare, GlassStaysGlassUnlessItIsChosen) {
  Scene glass = cube_scene();
  glass.materials[0].illum = 6;
  glass.materials[0].ni = 1.5f;
  glass.materials[0].opacity = 0.2f;
  resolve_material(glass.materials[0]);
  ASSERT_TRUE(glass.materials[0].transmissive());
  EXPECT_TRUE(with_share(glass, 0).material_of(0).transmissive());
  EXPECT_FALSE(with_share(glass, 100).material_of(0).transmissive());
}

}  // namespace
}  // namespace hybridrt
