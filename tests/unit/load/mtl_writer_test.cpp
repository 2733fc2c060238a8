// Materials, textures, colours and axes that are written and read again.

#include "core/load/mtl_writer.h"

#include "core/load/mtl_io.h"
#include "core/load/obj_writer.h"
#include "tests/support/obj_test.h"
#include "tests/support/textured_scenes.h"

namespace hybridrt {
namespace {

Scene load(const std::filesystem::path& path, Warnings& warnings, UpAxis up = UpAxis::y) {
  ThreadPool pool(2);
  LoadWatch watch;
  watch.textures = texel_files(pattern_named);
  return load_meshes({&path, 1}, up, pool, warnings, watch);
}

/// Writes the materials of an MTL text into another folder; what is said of them when they are read again.
Warnings written_again(const std::string& mtl, const MaterialKinds& kinds = {}) {
  const TemporaryFolder folder;
  folder.write("leaf.png", "x");
  folder.write("two words.png", "x");
  std::filesystem::create_directories(folder.path / "deep" / "er");
  std::vector<Material> materials;
  Warnings warnings;
  read_mtl(folder.write("a.mtl", mtl), materials, warnings, kinds);
  const std::filesystem::path path = folder.path / "deep" / "er" / "b.mtl";
  OutputFile file(path);
  write_mtl(materials, distinct_names(materials), path.parent_path(), file);
  file.commit();
  EXPECT_FALSE(contains(file_contents(path), folder.path.string())) << "names are relative";
  Warnings lost;
  warn_of_lost_materials(materials, path, lost);
  return lost;
}

TEST(MtlWriter, MaterialsReadBackTheSame) {
  EXPECT_EQ(written_again("newmtl a\nKd 0.1 0.2 0.3\nKs 0.5 0.5 0.4\nKe 1 2 3\nNs 77\nNi 1.5\nd 0.25\nTf 0.5 0.6 0.7\n"
                          "illum 7\nnewmtl b c\nnewmtl mirror\nKs 1\nillum 3\nnewmtl d\nillum 0\nKs 1\n"
                          "newmtl glass\nKd 0 0 0\nillum 4\nNi 1.3\nnewmtl thin\nillum 9\nTf 0.5\nKd 1 0 0\n"),
            Warnings());
}

TEST(MtlWriter, MapsReadBackTheSame) {
  EXPECT_EQ(written_again("newmtl a\nmap_Kd leaf.png\nnewmtl b\nKd 0 0 0\nmap_Kd two words.png\nnewmtl c\nKd 1 1 1\n"
                          "map_Kd -s 2 3 1 -o 0.5 0.25 0 leaf.png\nKs 0.5\nmap_Ks -mm 0.1 0.7 -clamp on leaf.png\n"
                          "newmtl d\nmap_Ks leaf.png\nmap_Ke leaf.png\nmap_d -imfchan m leaf.png\n"),
            Warnings());
}

TEST(MtlWriter, WhatAnotherFileSaidIsKept) {
  MaterialKinds kinds;
  kinds.glass = {"pane"};
  kinds.opaque = {"wall"};
  EXPECT_EQ(written_again("newmtl pane\nKd 0.5 0.5 0.5\nNi 1.5\nnewmtl wall\nd 0.5\nillum 7\n", kinds), Warnings());
}

TEST(MtlWriter, SaysWhatIsLost) {
  const Warnings lost = written_again("newmtl a\nnewmtl b\nmap_Kd nowhere.png\n");
  ASSERT_EQ(lost.size(), 1u);
  EXPECT_EQ(lost[0].code, WarningCode::material_changed);
  EXPECT_TRUE(contains(lost[0].text, "'b'")) << lost[0].text;
  EXPECT_TRUE(contains(lost[0].text, "1 material")) << lost[0].text;
}

TEST(MtlWriter, NamesAreDistinct) {
  std::vector<Material> materials(5);
  materials[0].name = materials[1].name = materials[3].name = "a";
  materials[2].name = "a_2";
  EXPECT_EQ(distinct_names(materials), (std::vector<std::string>{"a", "a_3", "a_2", "a_4", "unnamed"}));
}

TEST(ObjWriter, TexturesReadBackTheSameInAnotherFolder) {
  const TemporaryFolder folder;
  folder.write("leaf.png", "x");
  folder.write("a.mtl", "newmtl leaf\nmap_Kd leaf.png\nnewmtl plain\nKd 1 0 0\n");
  const auto path =
      folder.write("a.obj",
                   "mtllib a.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 0\nvt 0 0\nvt 1 0.125\nvt 0 1\nvt 7 7\n"
                   "usemtl leaf\nf 1/1 2/2 3/3\nf 2/2 4/4 3/1\nusemtl plain\nf 1 2 4\n");
  Warnings warnings;
  const Scene scene = load(path, warnings);
  write_obj(scene, folder.path / "else" / "b.obj");
  const Scene read = load(folder.path / "else" / "b.obj", warnings);
  EXPECT_EQ(warnings, Warnings());
  ASSERT_TRUE(read.textures);
  EXPECT_EQ(read.textures->words, scene.textures->words);
  EXPECT_EQ(read.textures->triangle_maps, scene.textures->triangle_maps);
  for (uint32_t t = 0; t < 2; ++t)
    for (int k = 0; k < 3; ++k)
      EXPECT_EQ(read.textures->texcoords[read.textures->triangle_texcoords[t][k]],
                scene.textures->texcoords[scene.textures->triangle_texcoords[t][k]]);
}

TEST(ObjWriter, ColoursStandBesideTheVertices) {
  Scene scene =
      load_text("v 0 0 0 1 0 0\nv 1 0 0 0 0.5 0\nv 0 1 0 0 0 1\nv 1 1 0 0.25 0.25 1\nf 1 2 3\nf 2 4 3\n").scene;
  ASSERT_TRUE(scene.has_colors());
  // Another colour at the same vertex: only two vertices of the file can hold it.
  scene.colors.push_back(vec3(0, 1, 1));
  scene.triangle_colors[1].x = static_cast<uint32_t>(scene.colors.size() - 1);
  const TemporaryFolder folder;
  write_obj(scene, folder.path / "a.obj");
  Warnings warnings;
  const Scene read = load(folder.path / "a.obj", warnings);
  EXPECT_EQ(warnings, Warnings());
  ASSERT_TRUE(read.has_colors());
  for (uint32_t t = 0; t < 2; ++t)
    for (int k = 0; k < 3; ++k) {
      EXPECT_EQ(read.vertex(t, k), scene.vertex(t, k));
      const vec3 a = read.colors[read.triangle_colors[t][k]], b = scene.colors[scene.triangle_colors[t][k]];
      for (int i = 0; i < 3; ++i) EXPECT_NEAR(a[i], b[i], 1e-6);
    }
}

TEST(ObjWriter, AxesOfTheFilesAreKept) {
  const std::string text = "v 0 0 1\nv 2 0 3\nv 0 5 7\nvn 0 0 1\nf 1//1 2//1 3//1\n";
  const TemporaryFolder folder;
  Warnings warnings;
  const Scene scene = load(folder.write("a.obj", text), warnings, UpAxis::z);
  write_obj(scene, folder.path / "b.obj", UpAxis::z);
  const Scene again = load(folder.path / "b.obj", warnings, UpAxis::z);
  EXPECT_EQ(again.positions, scene.positions);
  EXPECT_EQ(again.normals, scene.normals);
  EXPECT_TRUE(contains(file_contents(folder.path / "b.obj"), "v 2 -0 3\n") ||
              contains(file_contents(folder.path / "b.obj"), "v 2 0 3\n"));
  EXPECT_EQ(warnings, Warnings());
}

}  // namespace
}  // namespace hybridrt
