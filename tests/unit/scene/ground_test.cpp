#include "core/scene/ground.h"

#include <gtest/gtest.h>

#include "tests/support/load_obj.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/textured_scenes.h"

namespace hybridrt {
namespace {

void expect_ground_under(Scene scene) {
  const Scene before = scene;
  add_ground(scene, before.bounds);
  validate(scene);
  ASSERT_EQ(scene.triangle_count(), before.triangle_count() + 2);
  for (uint32_t i = 0; i < before.triangle_count(); ++i)
    ASSERT_EQ(scene.triangle_positions[i], before.triangle_positions[i]) << "triangles keep their numbers";
  const auto first = static_cast<uint32_t>(before.triangle_count());
  EXPECT_EQ(scene.material_of(first).name, "ground");
  for (uint32_t i : {first, first + 1}) {
    const vec3 a = scene.vertex(i, 0), b = scene.vertex(i, 1), c = scene.vertex(i, 2);
    EXPECT_LT(a.y, before.bounds.lo.y);
    EXPECT_GT(glm::cross(b - a, c - a).y, 0) << "it faces up";
  }
  EXPECT_LT(scene.bounds.lo.x, before.bounds.lo.x - 10 * before.bounds.extent().x);
  EXPECT_EQ(scene.bounds.hi.y, before.bounds.hi.y);
}

Scene from_text(const std::string& text) {
  ThreadPool pool(1);
  Warnings warnings;
  const TemporaryFolder folder;
  return load_obj(folder.write("a.obj", text), pool, warnings);
}

TEST(Ground, LiesUnderTheScene) { expect_ground_under(from_text("v 0 1 0\nv 1 1 0\nv 0 2 0\nf 1 2 3\n")); }

TEST(Ground, HasNoColourOfAVertex) {
  const Scene scene = from_text("v 0 1 0 1 0 0\nv 1 1 0 0 1 0\nv 0 2 0 0 0 1\nf 1 2 3\n");
  ASSERT_TRUE(scene.has_colors());
  expect_ground_under(scene);
}

TEST(Ground, HasNoTexture) {
  Scene scene = textured_room();
  expect_ground_under(scene);
  add_ground(scene, scene.bounds);
  EXPECT_EQ(scene.textures->triangle_maps.back(), 0);
}

}  // namespace
}  // namespace hybridrt
