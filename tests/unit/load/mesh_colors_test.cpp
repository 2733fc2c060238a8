#include "core/load/mesh_colors.h"

#include "core/image/srgb.h"
#include "tests/support/load_scene.h"
#include "tests/support/obj_test.h"
#include "tests/support/textured_scenes.h"

namespace hybridrt {
namespace {

using std::string;

struct MeshColors : testing::Test {
  TemporaryFolder folder;
  Warnings warnings;

  Scene load(const string& text, bool linear = false, const string& name = "a.obj") {
    LoadWatch watch;
    watch.textures = texel_files(pattern_named);
    watch.linear_colors = linear;
    ThreadPool pool(2);
    warnings.clear();
    return load_scene(folder.write(name, text).string(), pool, warnings, std::nullopt, watch);
  }
  static vec3 at(const Scene& scene, uint32_t triangle, int corner) {
    return scene.colors.at(scene.triangle_colors.at(triangle)[corner]);
  }
  static float linear(double display) { return static_cast<float>(linear_from_srgb(display)); }
};

const string kPainted = "v 0 0 0 1 0 .5\nv 1 0 0 0 1 0\nv 0 1 0 0 0 1\n";

TEST_F(MeshColors, AreTheDiffuseColourWithoutAMaterial) {
  const Scene scene = load(kPainted + "f 1 2 3\n");
  EXPECT_EQ(at(scene, 0, 0), vec3(1, 0, linear(.5)));
  EXPECT_EQ(at(scene, 0, 1), vec3(0, 1, 0));
  EXPECT_EQ(scene.material_of(0).kd, vec3(1));
  EXPECT_EQ(scene.materials.size(), 1u) << "no other default";
  EXPECT_TRUE(warnings.empty()) << "nothing was repaired or left out";
  EXPECT_EQ(
      scene.notes,
      std::vector<string>{"a.obj: the colours of its vertices (sRGB, 0 to 1) are the diffuse colour of 1 triangles"});
  EXPECT_EQ(scene.positions.size(), 3u) << "vertices are shared as before";
}

TEST_F(MeshColors, OfAFileAreBytesOrShares) {
  const Scene bytes = load("v 0 0 0 255 0 0\nv 1 0 0 1 1 1\nv 0 1 0 0 127.5 999\nf 1 2 3\n");
  EXPECT_EQ(at(bytes, 0, 0), vec3(1, 0, 0));
  EXPECT_EQ(at(bytes, 0, 1), vec3(linear(1 / 255.0)));
  EXPECT_EQ(at(bytes, 0, 2), vec3(0, linear(.5), 1));
  EXPECT_TRUE(contains(bytes.notes.at(0), "(sRGB, 0 to 255)"));
  const Scene shares = load("v 0 0 0 1 0 0\nv 1 0 0 1.0001 0 0\nv 0 1 0 -1 0 0\nf 1 2 3\n");
  EXPECT_EQ(at(shares, 0, 1), vec3(1, 0, 0)) << "rounded up";
  EXPECT_EQ(at(shares, 0, 2), vec3(0));
}

TEST_F(MeshColors, AreLinearWhereThatIsAskedFor) {
  const Scene scene = load(kPainted + "f 1 2 3\n", true);
  EXPECT_EQ(at(scene, 0, 0), vec3(1, 0, .5f));
  EXPECT_TRUE(contains(scene.notes.at(0), "(linear, 0 to 1)"));
}

TEST_F(MeshColors, MultiplyKdAndAreLeftOutUnderATexture) {
  folder.write("noise.png", "x");
  folder.write("a.mtl", "newmtl a\nKd .5 .5 .5\nmap_Ks noise.png\nnewmtl b\nmap_Kd noise.png\n");
  const Scene scene =
      load("mtllib a.mtl\nvt 0 0\n" + kPainted +
           "v 9 9 9\nf 1 2 4\nusemtl a\nf 1/1 2/1 3/1\nusemtl b\nf 1/1 2/1 3/1\nusemtl none\nf 1 2 3\n");
  EXPECT_EQ(at(scene, 0, 2), vec3(1)) << "no colour of its own";
  EXPECT_EQ(at(scene, 1, 0), vec3(1, 0, linear(.5)));
  EXPECT_EQ(at(scene, 2, 0), vec3(1));
  EXPECT_EQ(scene.material_of(1).kd, vec3(.5f));
  EXPECT_EQ(scene.material_of(0).kd, vec3(1));
  EXPECT_EQ(scene.material_of(3).kd, vec3(1)) << "an unknown material is none";
  EXPECT_TRUE(warned(warnings,
                     "(sRGB, 0 to 1) are the diffuse colour of 2 triangles, multiply Kd of 1 triangles, were left out "
                     "on 1 triangles with a map_Kd"));
}

TEST_F(MeshColors, ThatSayNothingAreLeftOut) {
  folder.write("noise.png", "x");
  folder.write("a.mtl", "newmtl b\nmap_Kd noise.png\n");
  const auto left_out = [&](const string& text) {
    const Scene scene = load(text);
    EXPECT_FALSE(scene.has_colors());
    EXPECT_TRUE(scene.colors.empty());
    EXPECT_EQ(warnings.size() + scene.notes.size(), 1u);
    return warnings.empty() ? scene.notes.at(0) : warnings[0].text;
  };
  EXPECT_EQ(left_out("v 0 0 0 0 0 0\nv 1 0 0 0 0 0\nv 0 1 0 0 0 0\nf 1 2 3\n"),
            "a.obj: the colours of its vertices are all black and were left out");
  EXPECT_EQ(left_out("v 0 0 0 255 255 255\nv 1 0 0 255 255 255\nv 0 1 0\nf 1 2 3\n"),
            "a.obj: the colours of its vertices are all white and change nothing");
  EXPECT_EQ(left_out("mtllib a.mtl\nusemtl b\nvt 0 0\n" + kPainted + "f 1/1 2/1 3/1\n"),
            "a.obj: the colours of its vertices were left out: its triangles have a map_Kd");
  EXPECT_EQ(load(kTriangle + "f 1 2 3\n").colors.capacity(), 0u) << "a scene without colours takes no memory for them";
}

TEST_F(MeshColors, SeveralMeshesOfWhichSomeAreColoured) {
  folder.write("plain.obj", kTriangle + "f 1 2 3\n");
  folder.write("painted.obj", "v 2 2 2\n" + kPainted + "f 2 3 4\nf 1 1 2\n");
  folder.write("other.obj", "v 0 0 0 0 1 1\nv 1 0 0 0 1 1\nv 0 1 0 0 1 1\nf 1 2 3\n");
  const Scene scene =
      load(R"({"meshes": ["plain.obj", "painted.obj", "plain.obj", "other.obj", "plain.obj"]})", false, "scene.json");
  ASSERT_EQ(scene.triangle_colors.size(), 5u);
  for (const uint32_t plain : {0u, 2u, 4u}) {
    EXPECT_EQ(at(scene, plain, 1), vec3(1));
    EXPECT_EQ(scene.material_of(plain).kd, vec3(.8f));
  }
  EXPECT_EQ(at(scene, 1, 1), vec3(0, 1, 0));
  EXPECT_EQ(at(scene, 3, 0), vec3(0, 1, 1));
  EXPECT_EQ(scene.materials.size(), 2u);
}

TEST_F(MeshColors, DoNotMindTrianglesThatAreLeftOut) {
  const Scene scene = load(kPainted + "f 1 1 2\nf 3 2 1\n");
  EXPECT_EQ(at(scene, 0, 0), vec3(0, 0, 1));
}

TEST_F(MeshColors, TheOnlyMaterialIsUsedWithoutUsemtl) {
  folder.write("a.mtl", "newmtl red\nKd 1 0 0\n");
  folder.write("b.mtl", "newmtl blue\nKd 0 0 1\n");
  const auto unnamed = [](const char* text) { return Warnings{{WarningCode::material_unnamed, text}}; };
  EXPECT_EQ(load("mtllib a.mtl\n" + kTriangle + "f 1 2 3\n").material_of(0).name, "red");
  EXPECT_EQ(warnings, unnamed("a.obj: no usemtl, so the one material of its MTL, 'red', is used for all of it"));
  EXPECT_EQ(load("mtllib a.mtl b.mtl\n" + kTriangle + "f 1 2 3\n").material_of(0).name, "default");
  EXPECT_EQ(warnings, unnamed("a.obj: no usemtl, so none of the 2 materials of its MTL is used; drawn as default"));
  EXPECT_EQ(load("mtllib a.mtl\n" + kTriangle + "f 1 2 3\nusemtl red\nf 3 2 1\n").material_of(0).name, "default");
  EXPECT_TRUE(warnings.empty());
}

}  // namespace
}  // namespace hybridrt
