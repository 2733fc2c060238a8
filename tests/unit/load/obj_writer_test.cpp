#include "core/load/obj_writer.h"

#include <gtest/gtest.h>

#include "core/load/scene_source.h"
#include "core/procedural/spheres.h"
#include "tests/support/obj_test.h"

namespace hybridrt {
namespace {

TEST(ObjWriter, WhatIsWrittenReadsBackTheSame) {
  const TemporaryFolder folder;
  const Scene scene = make_spheres({120'000, 35});
  const std::filesystem::path path = folder.path / "new folder" / "my spheres.obj";
  const WrittenObj written = write_obj(scene, path);
  EXPECT_EQ(written.obj_bytes, std::filesystem::file_size(path));
  EXPECT_EQ(written.mtl_bytes, std::filesystem::file_size(written.mtl));

  for (const int threads : {1, 3}) {
    ThreadPool pool(threads);
    Warnings warnings;
    const Scene read = load_obj(path, pool, warnings);
    EXPECT_TRUE(warnings.empty());
    EXPECT_EQ(read.origin_world, scene.origin_world);
    EXPECT_EQ(read.positions, scene.positions);
    EXPECT_EQ(read.normals, scene.normals);
    EXPECT_EQ(read.triangle_positions, scene.triangle_positions);
    EXPECT_EQ(read.triangle_normals, scene.triangle_normals);
    EXPECT_EQ(read.triangle_materials, scene.triangle_materials);
    EXPECT_EQ(read.bounds.lo, scene.bounds.lo);
    EXPECT_EQ(read.bounds.hi, scene.bounds.hi);
    ASSERT_EQ(read.materials.size(), scene.materials.size());
    for (size_t i = 0; i < read.materials.size(); ++i) {
      const Material &a = read.materials[i], &b = scene.materials[i];
      EXPECT_EQ(a.name, b.name);
      EXPECT_EQ(a.kd, b.kd);
      EXPECT_EQ(a.ks, b.ks);
      EXPECT_EQ(a.ns, b.ns);
      EXPECT_EQ(a.illum, b.illum);
      EXPECT_EQ(a.reflect, b.reflect);
      EXPECT_EQ(a.fresnel, b.fresnel);
    }
  }
}

TEST(ObjWriter, SameSceneSameBytes) {
  const TemporaryFolder folder;
  write_obj(make_spheres({5000, 10}), folder.path / "a.obj");
  const std::string first = file_contents(folder.path / "a.obj");
  write_obj(make_spheres({5000, 10}), folder.path / "a.obj");
  EXPECT_EQ(file_contents(folder.path / "a.obj"), first);
  EXPECT_FALSE(first.empty());
}

TEST(ObjWriter, AFarSceneReadsBackInItsPlace) {
  Scene scene = load_text("v 85000.25 447500.5 3\nv 85010.125 447500 3\nv 85000 447511.0625 4\nf 1 2 3\n").scene;
  ASSERT_NE(scene.origin_world, dvec3(0));
  const TemporaryFolder folder;
  write_obj(scene, folder.path / "far.obj");
  const Scene read = load_text(file_contents(folder.path / "far.obj")).scene;
  EXPECT_EQ(read.origin_world, scene.origin_world);
  EXPECT_EQ(read.positions, scene.positions);
}

TEST(ObjWriter, SaysWhatCannotBeWritten) {
  const TemporaryFolder folder;
  const Scene scene = make_spheres({1000, 10});
  std::filesystem::create_directory(folder.path / "taken.obj");
  folder.write("file", "");
  for (const auto& path : {folder.path / "taken.obj", folder.path / "file" / "x.obj"}) {
    try {
      write_obj(scene, path);
      ADD_FAILURE() << path;
    } catch (const Error& error) {
      EXPECT_EQ(error.kind(), ErrorKind::output);
    }
  }
  for (const auto& entry : std::filesystem::directory_iterator(folder.path))
    EXPECT_FALSE(contains(entry.path().string(), ".part")) << "nothing is left behind";
  EXPECT_FALSE(std::filesystem::exists(folder.path / "taken.mtl"));
}

}  // namespace
}  // namespace hybridrt
