// Loading uses all threads, and the result does not depend on them.

#include <cmath>

#include "core/mesh/topology.h"
#include "tests/support/load_scene.h"
#include "tests/support/obj_test.h"

namespace hybridrt {
namespace {

/// A hilly field of quads without normals, as OBJ; some quads occur twice, some have no area.
std::string field(int side) {
  std::string text = "mtllib none.mtl\n";
  for (int y = 0; y < side; ++y)
    for (int x = 0; x < side; ++x) text += fmt::format("v {} {:.6f} {}\n", x, std::sin(0.3 * x) * std::cos(0.7 * y), y);
  for (int y = 0; y + 1 < side; ++y) {
    text += fmt::format("usemtl row{}\n", y % 3);
    for (int x = 1; x < side; ++x) {
      const int at = y * side + x;
      text += fmt::format("f {} {} {} {}\n", at, at + side, at + side + 1, at + 1);
      if (x % 50 == 0) text += fmt::format("f {0} {0} {1}\nf {0} {1} {2} {3}\n", at, at + side, at + side + 1, at + 1);
    }
  }
  return text;
}

struct LoadThreads : testing::Test {
  const TemporaryFolder folder;

  std::string scene_of(std::string_view meshes) {
    return folder.write("scene.json", fmt::format(R"({{"meshes": [{}], "up_axis": "z"}})", meshes)).string();
  }
};

TEST_F(LoadThreads, ChangeNothing) {
  const std::string large = field(500), small = field(20);
  ASSERT_GT(large.size(), size_t{8} << 20) << "large enough for all threads";
  folder.write("large.obj", large), folder.write("small.obj", small);
  folder.write("a.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n");
  const std::string scene_file = scene_of(R"("small.obj", "large.obj", "a.off", "small.obj")");

  ThreadPool one(1);
  Warnings warnings;
  LoadProgress progress;
  const Scene scene = load_scene(scene_file, one, warnings, std::nullopt, {.progress = &progress});
  EXPECT_EQ(scene.triangle_count(), 2 * (499u * 499 + 499 * 9) + 4u * 19 * 19 + 1);
  EXPECT_FALSE(warnings.empty());
  EXPECT_EQ(progress.bytes, large.size() + 2 * small.size() + 36);
  EXPECT_EQ(progress.bytes_read, progress.bytes);
  const Topology topology = build_topology(scene, one);

  for (const int threads : {2, 5}) {
    ThreadPool pool(threads);
    Warnings again;
    const Scene same = load_scene(scene_file, pool, again);
    EXPECT_EQ(again, warnings);
    EXPECT_EQ(same.positions, scene.positions);
    EXPECT_EQ(same.normals, scene.normals);
    EXPECT_EQ(same.triangle_positions, scene.triangle_positions);
    EXPECT_EQ(same.triangle_normals, scene.triangle_normals);
    EXPECT_EQ(same.triangle_materials, scene.triangle_materials);
    EXPECT_EQ(same.materials.size(), scene.materials.size());
    EXPECT_EQ(build_topology(same, pool).component_of_triangle, topology.component_of_triangle);
  }
}

TEST_F(LoadThreads, TheFirstFilesFaultIsTheOneToHearOf) {
  folder.write("large.obj", field(400) + "f 0 0 0\n");
  folder.write("bad.obj", "v 1 2\n");
  folder.write("good.obj", kTriangle + "f 1 2 3\n");
  for (const int threads : {1, 4}) {
    ThreadPool pool(threads);
    Warnings warnings;
    const auto message = [&](std::string_view meshes) -> std::string {
      try {
        load_scene(scene_of(meshes), pool, warnings);
      } catch (const Error& refused) {
        return refused.what();
      }
      return "loaded";
    };
    EXPECT_TRUE(contains(message(R"("good.obj", "bad.obj", "large.obj")"), "bad.obj:1:"));
    EXPECT_TRUE(contains(message(R"("good.obj", "large.obj", "bad.obj")"), "large.obj:"));
  }
}

}  // namespace
}  // namespace hybridrt
