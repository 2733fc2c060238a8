// What d, Tr, Tf and illum say together, and what a scene JSON says instead.

#include "core/load/mtl_opacity.h"

#include "core/load/mtl_io.h"
#include "tests/support/load_scene.h"
#include "tests/support/obj_test.h"

namespace hybridrt {
namespace {

using std::string;

struct MtlOpacityTest : testing::Test {
  TemporaryFolder folder;
  Warnings warnings;

  Material read(const string& statements, const MaterialKinds& kinds = {}) {
    std::vector<Material> materials;
    warnings.clear();
    read_mtl(folder.write("test.mtl", "newmtl m\n" + statements), materials, warnings, kinds);
    return materials.at(0);
  }
};

TEST_F(MtlOpacityTest, Tr1AloneIsOpaque) {
  for (const string more :
       {"", "illum 1\n", "illum 2\nKd 1 1 1\nmap_Kd a.png\n", "Tf 1 1 1\n", "Tf 1\n", "illum 5\n"}) {
    const Material m = read("Tr 1.000000\n" + more);
    EXPECT_EQ(m.opacity, 1) << more;
    EXPECT_FALSE(m.transmissive()) << more;
    EXPECT_TRUE(warned(warnings, "test.mtl: 1 materials say Tr 1 and no d, and are drawn opaque ('m')")) << more;
  }
}

TEST_F(MtlOpacityTest, Tr1IsClearWhereMoreSaysSo) {
  for (const string more : {"illum 6\n", "illum 7\nKd .5 .5 .5\n", "Tf .9 1 1\n", "Tf 0\n", "illum 4\nKd 0 0 0\n",
                            "illum 9\n", "Tf spectral a.rfl\n"}) {
    EXPECT_EQ(read("Tr 1\n" + more).opacity, 0) << more;
    EXPECT_FALSE(warned(warnings, "Tr 1")) << more;
  }
  EXPECT_EQ(read("Tr 1\nd 0\n").opacity, 0) << "d counts";
  EXPECT_EQ(read("Tr 1\nd 0.25\n").opacity, 0.25f);
  EXPECT_FLOAT_EQ(read("Tr 0.9\n").opacity, 0.1f);
  EXPECT_TRUE(warnings.empty());
}

TEST_F(MtlOpacityTest, GlassThatNothingElseSpeaksOfIsOpaque) {
  folder.write("a.png", "x");
  for (const string more : {"Kd .8 .2 .2\n", "Kd .8 .2 .2\nTf 1.00 1.00 1.00\nNi 1.5\nKs .5\n",
                            "Kd 0 0 0\nmap_Kd a.png\n", "map_Kd a.png\nd 1\n", "Kd 0 0 .1\nTr 0\n", "Kd 1 1 1\nTr 1\n"})
    for (const string illum : {"illum 4\n", "illum 9\n"}) {
      const Material m = read(illum + more);
      EXPECT_EQ(m.illum, 2) << more;
      EXPECT_EQ(m.opacity, 1) << more;
      EXPECT_EQ(m.ni, 1) << more;
      EXPECT_FALSE(m.transmissive() || m.reflective()) << more;
      EXPECT_EQ(warnings.size(), 1u) << more;
      EXPECT_TRUE(warned(warnings, "1 materials say illum 4 or 9 but have a colour")) << more;
    }
}

TEST_F(MtlOpacityTest, GlassIsMeant) {
  folder.write("a.png", "x");
  for (const string more : {"", "Kd 0 0 0\n", "Ni 1.5\nKs .3\n", "Kd .1 .1 .1\nTf .4 .4 .4\n", "Kd .5 .5 .5\nd .5\n",
                            "Kd .5 .5 .5\nmap_d a.png\n", "map_Kd a.png\nTf .9 .97 .93\n"}) {
    EXPECT_EQ(read("illum 4\n" + more).illum, 4) << more;
    EXPECT_TRUE(read("illum 9\n" + more).transmissive()) << more;
    EXPECT_TRUE(warnings.empty()) << more;
  }
  EXPECT_TRUE(read("illum 6\nKd .5 .5 .5\n").transmissive()) << "asks for refraction by name";
  EXPECT_TRUE(read("illum 7\nKd .5 .5 .5\nmap_Kd a.png\nTf 1 1 1\n").transmissive());
  EXPECT_TRUE(warnings.empty());
}

TEST_F(MtlOpacityTest, AWishGoesBeforeAll) {
  const MaterialKinds glass{"s.json", {"m"}, {}}, opaque{"s.json", {}, {"m"}};
  EXPECT_EQ(read("illum 4\nKd .8 .2 .2\nNi 1.5\n", glass).fresnel, Fresnel::dielectric);
  EXPECT_EQ(read("illum 2\nKd .8 .2 .2\nNi 1.5\n", glass).illum, 4);
  EXPECT_EQ(read("Tr 1\n", glass).opacity, 0);
  EXPECT_EQ(read("illum 7\n", glass).illum, 7);
  for (const string statements : {"illum 6\nTf .5\n", "d 0\n", "illum 4\nKd 0 0 0\nd .2\n", "Tr .3\n"}) {
    const Material m = read(statements, opaque);
    EXPECT_EQ(m.opacity, 1) << statements;
    EXPECT_FALSE(m.transmissive()) << statements;
  }
  EXPECT_EQ(read("illum 3\nKs .5\nd 0\n", opaque).reflect, vec3(.5f)) << "still a mirror";
  EXPECT_TRUE(warnings.empty());
}

TEST_F(MtlOpacityTest, WishesMustNameMaterials) {
  folder.write("a.mtl", "newmtl m\nillum 4\nKd 1 0 0\nnewmtl unused\n");
  folder.write("a.obj", kTriangle + "mtllib a.mtl\nusemtl m\nf 1 2 3\n");
  ThreadPool pool(1);
  const auto load = [&](const string& more) {
    warnings.clear();
    return load_scene(folder.write("s.json", R"({"meshes":["a.obj"],)" + more + "}").string(), pool, warnings);
  };
  EXPECT_FALSE(load(R"("opaque":["m"])").material_of(0).transmissive());
  EXPECT_TRUE(load(R"("glass":["m","unused"])").material_of(0).transmissive());
  EXPECT_TRUE(warnings.empty());
  try {
    load(R"("glass":["m","n"])");
    ADD_FAILURE();
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::input);
    EXPECT_TRUE(contains(error.what(), "s.json: glass: no MTL file of its meshes defines the material 'n'"));
  }
}

}  // namespace
}  // namespace hybridrt
