#include "core/scene/framing.h"

#include <gtest/gtest.h>

#include "tests/support/trace_scenes.h"

namespace hybridrt {
namespace {

void add_speck(Scene& scene, const vec3& p, float size = 0.01f) {
  add_triangle(scene, p, p + size * vec3(1, 0, 0), p + size * vec3(0, 1, 0));
  for (int k = 0; k < 3; ++k) scene.bounds.grow(scene.positions[scene.positions.size() - 1 - k]);
}

TEST(Framing, LeavesOutStrayTriangles) {
  Scene scene = closed_box();
  const Aabb box = scene.bounds;
  add_speck(scene, {1000, 0, 0});
  const Framing framing = frame_scene(scene);
  EXPECT_EQ(framing.left_out, 1);
  EXPECT_EQ(framing.bounds.lo, box.lo);
  EXPECT_EQ(framing.bounds.hi, box.hi);
  EXPECT_EQ(framing.an_outlier, vec3(1000, 0, 0));
}

TEST(Framing, LeavesOutWhatLiesAtSeveralDistances) {
  Random random(8);
  for (int i = 0; i < 20; ++i) {
    Scene scene = random_soup(i, 2000, 0.3f);
    const Aabb soup = scene.bounds;
    const int specks = 1 + static_cast<int>(random.below(20));  // 1 % of the triangles
    for (int k = 0; k < specks; ++k) add_speck(scene, std::pow(10.0f, random.between(1.6f, 5)) * random.direction());
    const Framing framing = frame_scene(scene);
    EXPECT_EQ(framing.left_out, specks);
    EXPECT_EQ(framing.bounds.lo, soup.lo);
    EXPECT_EQ(framing.bounds.hi, soup.hi);
  }
}

TEST(Framing, KeepsWhatIsAPartOfTheScene) {
  for (const NamedScene& named : all_test_scenes()) EXPECT_EQ(frame_scene(named.scene).left_out, 0) << named.name;

  Scene many = random_soup(1, 1000, 0.3f);  // 3 % of the triangles
  for (int i = 0; i < 30; ++i) add_speck(many, vec3(1000 + i, 0, 0));
  EXPECT_EQ(frame_scene(many).left_out, 0);

  Scene large = random_soup(1, 1000, 0.3f);  // most of the area
  add_speck(large, vec3(1000, 0, 0), 500);
  EXPECT_EQ(frame_scene(large).left_out, 0);

  Scene near = closed_box();  // three times as large
  add_speck(near, vec3(2.9f, 0.5f, 0.5f));
  EXPECT_EQ(frame_scene(near).left_out, 0);
}

}  // namespace
}  // namespace hybridrt
