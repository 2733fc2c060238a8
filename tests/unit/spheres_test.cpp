#include "core/scene/spheres.h"

#include <map>

#include "core/scene/obj_writer.h"
#include "core/scene/scene_source.h"
#include "tests/unit/obj_test.h"

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
  EXPECT_EQ(make_spheres({3000, 50}).triangle_count(),
            static_cast<size_t>(plan_spheres({3000, 50}).triangles()));
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

TEST(Spheres, RefuseWhatIsOutOfRange) {
  for (const SpheresOptions& bad :
       {SpheresOptions{99, 10}, SpheresOptions{20'000'001, 10}, SpheresOptions{1000, -1},
        SpheresOptions{1000, 101}, SpheresOptions{1000, std::nan("")}}) {
    try {
      plan_spheres(bad);
      ADD_FAILURE();
    } catch (const Error& error) {
      EXPECT_EQ(error.kind(), ErrorKind::usage);
    }
  }
}

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
  Scene scene =
      load_text("v 85000.25 447500.5 3\nv 85010.125 447500 3\nv 85000 447511.0625 4\nf 1 2 3\n").scene;
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

TEST(SceneSource, TakesProceduralScenesAndFiles) {
  ThreadPool pool(2);
  Warnings warnings;
  const Scene made = load_scene("scene:spheres,triangles=3000,reflective=50", pool, warnings);
  EXPECT_EQ(made.positions, make_spheres({3000, 50}).positions);
  EXPECT_EQ(load_scene("scene:spheres", pool, warnings).triangle_count(), 500'000u);
  const TemporaryFolder folder;
  EXPECT_EQ(
      load_scene(folder.write("A.OBJ", kTriangle + "f 1 2 3\n").string(), pool, warnings).triangle_count(),
      1u);
}

TEST(SceneSource, SaysWhatIsAllowed) {
  const TemporaryFolder folder;
  const std::string blend = folder.write("a.blend", "x").string();
  const std::tuple<std::string, ErrorKind, std::string> cases[] = {
      {"scene:cubes", ErrorKind::usage, "spheres"},
      {"scene:", ErrorKind::usage, "spheres"},
      {"scene:spheres,colour=3", ErrorKind::usage, "triangles=N, reflective=PERCENT"},
      {"scene:spheres,triangles=many", ErrorKind::usage, "'many'"},
      {"scene:spheres,triangles=1000.5", ErrorKind::usage, "whole number"},
      {"scene:spheres,triangles", ErrorKind::usage, "triangles needs a number"},
      {"scene:spheres,triangles=5", ErrorKind::usage, "100 to 20000000"},
      {"scene:spheres,reflective=nan", ErrorKind::usage, "reflective"},
      {"scene:spheres,reflective=101", ErrorKind::usage, "0 to 100"},
      {"/nowhere/to/be/found.obj", ErrorKind::input, "does not exist"},
      {blend, ErrorKind::input, ".blend files are not read"},
      {folder.path.string(), ErrorKind::input, "is a directory"},
  };
  ThreadPool pool(1);
  Warnings warnings;
  for (const auto& [argument, kind, part] : cases) {
    try {
      load_scene(argument, pool, warnings);
      ADD_FAILURE() << argument;
    } catch (const Error& error) {
      EXPECT_EQ(error.kind(), kind) << argument;
      EXPECT_TRUE(contains(error.what(), part)) << error.what();
    }
  }
}

}  // namespace
}  // namespace hybridrt
