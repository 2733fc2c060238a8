#include "core/load/mtl_io.h"

#include "core/load/texture_name.h"
#include "tests/support/obj_test.h"

namespace hybridrt {
namespace {

using std::string;

std::vector<Material> read_text(std::string_view mtl, Warnings& warnings) {
  const TemporaryFolder folder;
  std::vector<Material> materials;
  read_mtl(folder.write("test.mtl", mtl), materials, warnings);
  return materials;
}

Material read_one(const string& statements) {
  Warnings warnings;
  return read_text("newmtl m\n" + statements, warnings).at(0);
}

TEST(Mtl, ReadsEveryNumber) {
  Warnings warnings;
  const auto materials = read_text(
      "# comment\r\nnewmtl  two words \r\n\tKa 1 1 1\r\n\tKd .1 .2 .3\r\nKs 0.5\r\nKe 4 5 6\r\nNs 30\r\nNi "
      "1.5\r\n"
      "d 0.25\r\nTf 0.9 0.8 0.7\r\nillum 4\r\nsharpness 60\r\nnewmtl b\r\n",
      warnings);
  ASSERT_EQ(materials.size(), 2u);
  const Material& m = materials[0];
  EXPECT_EQ(m.name, "two words");
  EXPECT_EQ(m.kd, vec3(.1f, .2f, .3f));
  EXPECT_EQ(m.ks, vec3(0.5f));
  EXPECT_EQ(m.ke, vec3(4, 5, 6));
  EXPECT_EQ(m.ns, 30);
  EXPECT_EQ(m.ni, 1.5f);
  EXPECT_EQ(m.opacity, 0.25f);
  EXPECT_EQ(m.tf, vec3(0.9f, 0.8f, 0.7f));
  EXPECT_EQ(m.illum, 4);
  EXPECT_EQ(m.transmit, 0.75f * m.tf) << "resolved";
  EXPECT_TRUE(warnings.empty());
}

TEST(Mtl, MissingStatementsHaveTheirDefaults) {
  const Material m = read_one("");
  EXPECT_EQ(m.kd, vec3(0.8f));
  EXPECT_EQ(m.ks, vec3(0));
  EXPECT_EQ(m.tf, vec3(1)) << "no Tf means that glass lets everything through";
  EXPECT_EQ(m.illum, 2);
  EXPECT_EQ(m.ns, 30);
  EXPECT_EQ(m.opacity, 1);
  EXPECT_EQ(read_one("illum 4\nNi 1.5\n").transmit, vec3(1));
}

TEST(Mtl, DissolveWinsOverTransparency) {
  EXPECT_FLOAT_EQ(read_one("Tr 0.3\n").opacity, 0.7f);
  EXPECT_FLOAT_EQ(read_one("d 0.9\nTr 0.3\n").opacity, 0.9f);
  EXPECT_FLOAT_EQ(read_one("Tr 0.3\nd 0.9\n").opacity, 0.9f);
  EXPECT_FLOAT_EQ(read_one("d -halo 0.4\n").opacity, 0.4f);
  EXPECT_FLOAT_EQ(read_one("d 7\n").opacity, 1);
}

TEST(Mtl, ClampsAndWarns) {
  Warnings warnings;
  const auto m =
      read_text("newmtl a\nNi 0\nKd -1 2 .5\nNs 1e9\nillum 11\nnewmtl b\nillum 4\nNi -1\nillum 2.5\n", warnings);
  EXPECT_EQ(m.at(0).ni, 1);
  EXPECT_EQ(m.at(0).kd, vec3(0, 2, .5f));
  EXPECT_EQ(m.at(0).ns, 1e4f);
  EXPECT_EQ(m.at(1).illum, 2);
  EXPECT_TRUE(warned(warnings, "2 indices of refraction (Ni) are not above 0 and were set to 1 (first at line 2)"));
  EXPECT_TRUE(warned(warnings, "2 illumination models (illum) are not 0 to 10 and were set to 2 (first at line 5)"));
}

TEST(Mtl, ColoursOfEightBitsAreTold) {
  Warnings warnings;
  const auto m =
      read_text("newmtl a\nKd 255 128 0\nnewmtl b\nKs 200\nnewmtl c\nKd 1.2\nKe 50\nnewmtl d\nKd 1\nKs 1\n", warnings);
  EXPECT_EQ(m.at(0).kd, vec3(255, 128, 0));
  EXPECT_EQ(warnings.size(), 1u);
  EXPECT_TRUE(warned(warnings, "test.mtl: 2 materials have a Kd or Ks far above 1: colours of 0 to 255? ('a', 'b')"));
}

TEST(Mtl, NumbersThatAreNoneAreErrors) {
  for (const string bad : {"Kd nan 0 0", "Kd 0 0 inf", "Ns nan", "Ni NaN", "d nan", "Tr -nan", "illum x", "Ks 1e39",
                           "Ke", "Tf 1 2", "Kd 1,5 0 0"}) {
    Warnings warnings;
    try {
      read_text("newmtl m\n" + bad + "\n", warnings);
      ADD_FAILURE() << bad;
    } catch (const Error& error) {
      EXPECT_EQ(error.kind(), ErrorKind::input);
      EXPECT_TRUE(contains(error.what(), "test.mtl:2: ")) << error.what();
    }
  }
}

TEST(Mtl, CountsTexturesAndForeignColours) {
  Warnings warnings;
  read_text(
      "newmtl m\nmap_Kd -o 1 2 a b.png\nbump x.png\nmap_Ka a.png\nKd spectral a.rfl\nKs xyz 1 1 1\n"
      "map_Ks /etc/passwd\nmap_Ns y.png\n",
      warnings);
  EXPECT_TRUE(warned(warnings, "test.mtl: 2 texture maps (bump, disp and others) are not read yet (first at line 3)"));
  EXPECT_TRUE(warned(warnings, "2 colours are given as spectral or xyz"));
}

TEST(Mtl, TextureNamesArePickedOutOfTheirOptions) {
  EXPECT_EQ(read_texture_statement(" a.png").name, "a.png");
  EXPECT_EQ(read_texture_statement(" -o 1 2 my wood.png ").name, "my wood.png");
  EXPECT_EQ(read_texture_statement("-s 1 1 1 -mm 0 1 -bm 0.3 -clamp on -imfchan r -type sphere a b.png").name,
            "a b.png");
  EXPECT_EQ(read_texture_statement("-o 0.5 3.png").name, "3.png") << "fewer numbers than three";
  EXPECT_EQ(read_texture_statement("a-b -c.png -texres 64").name, "a-b -c.png") << "an option after the name";
  EXPECT_EQ(read_texture_statement("-o -1 -2 -3 x.png").name, "x.png");
  EXPECT_EQ(read_texture_statement("-blendu on").name, "");
}

TEST(Mtl, TextureOptionsInFrontAndBehind) {
  const TextureMap map = read_texture_statement("-s 2 3 1 -mm 0.1 0.4 a b.png -o .5 -.25 -clamp on -imfchan m").map;
  EXPECT_EQ(map.scale, vec2(2, 3));
  EXPECT_EQ(map.offset, vec2(.5f, -.25f));
  EXPECT_TRUE(map.clamped);
  EXPECT_EQ(map.base, 0.1f);
  EXPECT_EQ(map.gain, 0.4f);
  EXPECT_EQ(map.channel, 'm');

  const TextureMap odd =
      read_texture_statement("-s 5 -clamp off -imfchan rgb -mm x 1e99 -bm 3 -t 1 1 1 -texres 512 x.png").map;
  EXPECT_EQ(odd.scale, vec2(5, 1)) << "what is not given stays";
  EXPECT_FALSE(odd.clamped);
  EXPECT_EQ(odd.base, 0);
  EXPECT_EQ(odd.gain, 1e6f);
  EXPECT_EQ(odd.channel, 0);
}

TEST(Mtl, KeepsTheLastMapOfAKind) {
  const TemporaryFolder folder;
  folder.write("a.png", "x");
  folder.write("b.png", "x");
  Warnings warnings;
  std::vector<Material> materials;
  read_mtl(folder.write("test.mtl",
                        "newmtl m\nKs .5\nmap_Kd a.png\nmap_Ks b.png\nbump a.png\nmap_d gone.png\n"
                        "map_Kd -s 2 b.png\nnewmtl n\nKd 0\nmap_Kd a.png\nnewmtl o\nKd 0 0 1\n"
                        "map_Kd a.png\nmap_Ke b.png\n"),
           materials, warnings);
  ASSERT_EQ(materials.at(0).maps.size(), 3u);
  const std::vector<TextureMap>& maps = materials[0].maps;
  EXPECT_EQ(maps[0].kind, MapKind::specular);
  EXPECT_FALSE(maps[0].alone) << "Ks is given";
  EXPECT_EQ(maps[1].kind, MapKind::holes);
  EXPECT_TRUE(maps[1].path.empty());
  EXPECT_EQ(maps[2].kind, MapKind::diffuse);
  EXPECT_EQ(maps[2].path, folder.path / "b.png");
  EXPECT_EQ(maps[2].scale, vec2(2, 1));
  EXPECT_TRUE(maps[2].alone) << "no Kd";
  EXPECT_TRUE(materials.at(1).maps.at(0).alone) << "black";
  EXPECT_FALSE(materials.at(2).maps.at(0).alone);
  EXPECT_TRUE(materials.at(2).maps.at(1).alone) << "no Ke";
}

TEST(Mtl, SaysWhichTexturesAreMissingOrElsewhere) {
  const TemporaryFolder folder;
  folder.write("wood.png", "x");
  Warnings warnings;
  std::vector<Material> materials;
  read_mtl(folder.write("test.mtl",
                        "newmtl m\nmap_Kd C:\\x\\wood.png\nmap_Ks gone away.png\nmap_Ke gone away.png\nbump b.png\n"
                        "newmtl n\nmap_Kd C:\\x\\wood.png\nmap_Ks Wood.png\nbump WOOD.png\n"),
           materials, warnings);
  EXPECT_TRUE(warned(warnings, "test.mtl: 2 texture files are missing ('gone away.png', 'b.png') (first at line 3)"));
  EXPECT_TRUE(warned(warnings,
                     "test.mtl: 2 texture names lead to no file as written; found by case, decoding or their last part "
                     "('C:\\x\\wood.png', 'Wood.png'; first as " +
                         (folder.path / "wood.png").string() + ")"))
      << "a bump map is not read";
}

TEST(Mtl, MapKeywordsInAnyCaseAndMapsWithoutAName) {
  const TemporaryFolder folder;
  for (const char* name : {"a.png", "b c.png", "d -s e.png"}) folder.write(name, "x");
  Warnings warnings;
  std::vector<Material> materials;
  read_mtl(folder.write("test.mtl",
                        "newmtl m\nmap_KD a.png\nMAP_KS a.png\nmap_ke a.png\nmap_D a.png\nnewmtl n\nKd .1 .2 .3\n"
                        "map_Kd \nmap_Ks\nmap_Ke -s 1 1 1\nmap_d \"\"\nbump\nnewmtl o\nmap_Kd a.png\nmap_Kd\n"
                        "newmtl p\nmap_Kd -s 2 2 2 \"b c.png\" -o 1\nmap_Ks \"d -s e.png\" -clamp on\n"),
           materials, warnings);
  EXPECT_EQ(materials.at(0).maps.size(), 4u);
  EXPECT_TRUE(materials.at(1).maps.empty());
  EXPECT_EQ(materials.at(1).kd, vec3(.1f, .2f, .3f));
  EXPECT_TRUE(materials.at(2).maps.empty()) << "the last counts";
  ASSERT_EQ(materials.at(3).maps.size(), 2u);
  EXPECT_EQ(materials[3].maps[0].path, folder.path / "b c.png");
  EXPECT_EQ(materials[3].maps[0].scale, vec2(2));
  EXPECT_EQ(materials[3].maps[0].offset, vec2(1, 0));
  EXPECT_EQ(materials[3].maps[1].path, folder.path / "d -s e.png");
  EXPECT_TRUE(materials[3].maps[1].clamped);
  EXPECT_EQ(warnings.size(), 1u);
  EXPECT_TRUE(warned(warnings, "2 texture names lead to no file as written")) << "they are in quotes";
}

TEST(Mtl, EveryIlluminationModelIsOneRowOfTheTable) {
  // core/scene/material.h, with Ks 0.5, Ni 1.5 and d 1.
  struct Row {
    bool highlight, mirror, glass;
    Fresnel fresnel;
  };
  const Row rows[] = {{false, false, false, Fresnel::none},    {false, false, false, Fresnel::none},
                      {true, false, false, Fresnel::none},     {true, true, false, Fresnel::none},
                      {true, true, true, Fresnel::dielectric}, {true, true, false, Fresnel::schlick},
                      {true, true, true, Fresnel::dielectric}, {true, true, true, Fresnel::dielectric},
                      {true, true, false, Fresnel::none},      {true, true, true, Fresnel::dielectric},
                      {true, false, false, Fresnel::none}};
  for (int illum = 0; illum <= 10; ++illum) {
    const Material m = read_one("Ks 0.5\nNi 1.5\nillum " + std::to_string(illum) + "\n");
    EXPECT_EQ(m.ks != vec3(0), rows[illum].highlight) << illum;
    EXPECT_EQ(m.reflect != vec3(0), rows[illum].mirror) << illum;
    EXPECT_EQ(m.transmissive(), rows[illum].glass) << illum;
    EXPECT_EQ(m.fresnel, rows[illum].fresnel) << illum;
    EXPECT_EQ(m.ni, rows[illum].glass ? 1.5f : 1.0f) << illum;
    EXPECT_TRUE(read_one("d 0.4\nillum " + std::to_string(illum) + "\n").transmissive()) << illum;
  }
}

struct ObjWithLibraries : testing::Test {
  TemporaryFolder folder;
  ThreadPool pool{2};
  Warnings warnings;

  Scene load(const string& obj) { return load_obj(folder.write("test.obj", kTriangle + obj), pool, warnings); }
};

TEST_F(ObjWithLibraries, ReadsThemAll) {
  folder.write("a.mtl", "newmtl a\nKd 1 0 0\n");
  folder.write("b.mtl", "newmtl b\nKd 0 1 0\n");
  folder.write("my own.mtl", "newmtl my red\nKd 0 0 1\n");
  std::filesystem::create_directory(folder.path / "sub");
  folder.write("sub/d.mtl", "newmtl d\n");
  const Scene scene = load(
      "mtllib a.mtl b.mtl my own.mtl\nusemtl b\nf 1 2 3\nusemtl my red \nf 1 2 3\nusemtl a\n"
      "f 1 2 3\nmtllib sub\\d.mtl\nmtllib a.mtl\nusemtl d\nf 3 2 1\n");
  EXPECT_TRUE(warnings.empty());
  ASSERT_EQ(scene.materials.size(), 4u);
  const char* expected[] = {"b", "my red", "a", "d"};
  for (uint32_t t = 0; t < 4; ++t) EXPECT_EQ(scene.material_of(t).name, expected[t]);
}

TEST_F(ObjWithLibraries, MissingOnesAndUnknownNamesGiveDefault) {
  folder.write("a.mtl", "newmtl a\nKd 1 0 0\n");
  const Scene scene =
      load("mtllib gone.mtl a.mtl\nmtllib lost.mtl\nf 1 2 3\nusemtl a\nf 1 2 3\nusemtl none\nf 1 2 3\n");
  ASSERT_EQ(scene.materials.size(), 2u);
  EXPECT_EQ(scene.material_of(0).name, "default");
  EXPECT_EQ(scene.material_of(0).kd, vec3(0.8f));
  EXPECT_EQ(scene.material_of(1).name, "a");
  EXPECT_EQ(scene.material_of(2).name, "default");
  EXPECT_TRUE(warned(warnings, "2 material files are missing (first: 'gone.mtl')"));
  EXPECT_TRUE(warned(warnings, "1 triangles use materials that no MTL file defines ('none')"));
}

TEST_F(ObjWithLibraries, FoundElsewhereWithAWord) {
  std::filesystem::create_directories(folder.path / "Mats");
  folder.write("Mats/A b.mtl", "newmtl a\n");
  folder.write("c.mtl", "newmtl c\n");
  folder.write("d.mtl", "newmtl d\n");
  const Scene scene = load(
      "mtllib mats\\a b.MTL C:\\x\\c.mtl gone/d.mtl lost.mtl\nusemtl a\nf 1 2 3\nusemtl c\nf 1 2 3\n"
      "usemtl d\nf 1 2 3\n");
  ASSERT_EQ(scene.materials.size(), 3u);
  EXPECT_EQ(warnings.size(), 2u);
  EXPECT_TRUE(warned(warnings, "1 material files are missing (first: 'lost.mtl')"));
  EXPECT_TRUE(warned(warnings,
                     "3 material files are not there as written; found by case, decoding or their last part "
                     "('mats\\a b.MTL', 'C:\\x\\c.mtl', 'gone/d.mtl'; first as " +
                         (folder.path / "Mats/A b.mtl").string() + ")"));
}

TEST_F(ObjWithLibraries, TexturesAreLookedForBesideTheObjToo) {
  std::filesystem::create_directories(folder.path / "sub");
  folder.write("sub/a.mtl", "newmtl a\nmap_Kd sub/tex.png\nmap_Ks tex.png\nmap_Ke obj.png\n");
  folder.write("sub/tex.png", "x");
  folder.write("tex.png", "x");
  folder.write("obj.png", "x");
  std::vector<std::string> files;
  const auto materials = read_libraries(folder.path, {"sub/a.mtl"}, files, warnings);
  EXPECT_TRUE(warnings.empty());
  ASSERT_EQ(materials.at(0).maps.size(), 3u);
  EXPECT_EQ(materials[0].maps[0].path, folder.path / "sub/tex.png");
  EXPECT_EQ(materials[0].maps[1].path, folder.path / "sub/tex.png") << "beside the MTL first";
  EXPECT_EQ(materials[0].maps[2].path, folder.path / "obj.png");
}

TEST_F(ObjWithLibraries, TheFirstOfEqualNamesCounts) {
  folder.write("a.mtl", "newmtl a\nKd 1 0 0\nnewmtl a\nKd 0 1 0\n");
  const Scene scene = load("mtllib a.mtl\nusemtl a\nf 1 2 3\n");
  ASSERT_EQ(scene.materials.size(), 1u);
  EXPECT_EQ(scene.materials[0].kd, vec3(1, 0, 0));
  EXPECT_TRUE(warned(warnings, "1 materials are defined again"));
}

}  // namespace
}  // namespace hybridrt
