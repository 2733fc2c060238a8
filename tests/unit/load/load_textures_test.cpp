// From MTL statements to textures, with pictures that need no files.

#include "core/load/load_textures.h"

#include <atomic>
#include <chrono>
#include <thread>

#include "shaders/shared.h"
#include "tests/support/load_scene.h"
#include "tests/support/obj_test.h"
#include "tests/support/textured_scenes.h"

namespace hybridrt {
namespace {

using std::string;

const string kQuads = "mtllib a.mtl\nvt 0 0\nvt 1 0\nvt 1 1\nv 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 0\n";

struct LoadTextures : testing::Test {
  TemporaryFolder folder;
  Warnings warnings;
  std::atomic<int> reads = 0;

  LoadTextures() {
    for (const char* name : {"noise.png", "noise2.png", "leaf.png", "mask.png", "torn.png", "blank.png", "faint.png",
                             "black.png", "grey.jpg", "grey2.jpg"})
      folder.write(name, "x");
  }
  Scene load(const string& mtl, const string& faces, LoadWatch watch = {}, int threads = 2) {
    folder.write("a.mtl", mtl);
    const string obj = folder.write("a.obj", kQuads + faces).string();
    watch.textures = texel_files(pattern_named);
    watch.textures.read = [this](const std::filesystem::path& path, int side, uint64_t most) {
      ++reads;
      return pattern_named(path, side, most);
    };
    ThreadPool pool(threads);
    warnings.clear();
    return load_scene(obj, pool, warnings, std::nullopt, watch);
  }
  static uint32_t record(const Scene& scene, uint32_t triangle, uint32_t kind) {
    const uint32_t maps = scene.textures->triangle_maps.at(triangle);
    return maps ? scene.textures->words.at(maps + kind) : 0;
  }
};

TEST_F(LoadTextures, KeepsTextureCoordinatesOfCorners) {
  const Scene scene =
      load("newmtl a\nmap_Kd noise.png\nnewmtl b\n", "usemtl a\nf 1/1 2/2 4/3 3/-2\nusemtl b\nf 1 2 3\n");
  ASSERT_TRUE(scene.textures);
  const Textures& t = *scene.textures;
  ASSERT_EQ(t.triangle_texcoords.size(), 3u);
  const auto at = [&](uint32_t triangle, int corner) { return t.texcoords[t.triangle_texcoords[triangle][corner]]; };
  for (uint32_t triangle = 0; triangle < 2; ++triangle)  // corner by corner, however the quad was cut
    for (int corner = 0; corner < 3; ++corner) {
      const vec3 p = scene.vertex(triangle, corner);
      EXPECT_EQ(at(triangle, corner), p == vec3(0) ? vec2(0) : p == vec3(1, 1, 0) ? vec2(1) : vec2(1, 0));
    }
  EXPECT_EQ(at(2, 0), vec2(0));
  EXPECT_NE(record(scene, 0, HRT_MAP_DIFFUSE), 0u);
  EXPECT_EQ(t.triangle_maps[2], 0u);
  EXPECT_TRUE(warnings.empty()) << "triangles without a texture need no coordinates";
  EXPECT_EQ(scene.files.back(), (folder.path / "noise.png").string());
  EXPECT_EQ(scene.material_of(0).kd, vec3(1)) << "no Kd: the map's own colours";
}

TEST_F(LoadTextures, NothingIsKeptWithoutMaps) {
  EXPECT_FALSE(load("newmtl a\n", "usemtl a\nf 1/1 2/2 3/3\n").textures);
  EXPECT_FALSE(load("newmtl a\nnewmtl b\nmap_Kd noise.png\n", "usemtl a\nf 1/1 2/2 3/3\n").textures)
      << "no triangle uses b";
  EXPECT_FALSE(load("newmtl a\nmap_Ks gone.png\n", "usemtl a\nf 1/1 2/2 3/3\n").textures);
  EXPECT_EQ(reads, 0);
}

TEST_F(LoadTextures, AlphaOfZeroEverywhereIsOpaque) {
  const Scene scene = load("newmtl a\nmap_Kd blank.png\n", "usemtl a\nf 1/1 2/2 3/3\n");
  EXPECT_EQ(warnings,
            (Warnings{{WarningCode::texture_without_alpha,
                       "1 textures have an alpha of 0 in every texel, which was taken as opaque ('blank.png')"}}));
  EXPECT_FALSE(scene.has_holes());
  const uint32_t first = scene.textures->words.at(record(scene, 0, HRT_MAP_DIFFUSE) + HRT_TEXTURE_FIRST);
  EXPECT_EQ(scene.textures->words.at(first) >> 24, 255u);
}

TEST_F(LoadTextures, InvisibleMaterialsAreTold) {
  const auto told = [&](const string& statements) {
    load("newmtl a\n" + statements, "usemtl a\nf 1/1 2/2 3/3\nf 2/2 4/1 3/3\n");
    return warnings.size() == 1 ? warnings[0].text : fmt::format("{} warnings", warnings.size());
  };
  const string invisible = "material 'a': all its 2 triangles are invisible (";
  EXPECT_TRUE(told("d 0\n").starts_with(invisible + "d 0)"));
  EXPECT_TRUE(told("d 0.001\nKs 0.5\nNs 0\n").starts_with(invisible + "d 0)"));
  EXPECT_TRUE(told("d 0\nmap_Kd noise.png\nNi 1.3\n").starts_with(invisible + "d 0)"));
  EXPECT_TRUE(told("d 0\nKs 0.5\nNs 9\n").starts_with(invisible + "d 0, at most its highlights"));
  EXPECT_TRUE(told("illum 6\nKd 0\n").starts_with(invisible + "clear glass of Ni 1)"));
  EXPECT_TRUE(told("map_Kd faint.png\n").starts_with(invisible + "its texture is all holes)"));
  EXPECT_TRUE(told("map_d black.png\n").starts_with(invisible + "its texture is all holes)"));
  for (const string seen : {"d 0.1\n", "illum 6\nKd 0\nNi 1.5\n", "illum 6\nKd 0\nTf 1 1 .9\n", "illum 6\n",
                            "map_Kd leaf.png\n", "illum 6\nKd 0\nKs .1\n", "d 0\nKe 0 0 .1\n"})
    EXPECT_EQ(told(seen), "0 warnings") << seen;
}

TEST_F(LoadTextures, AFileIsReadOnce) {
  const Scene scene =
      load("newmtl a\nmap_Kd noise.png\nmap_Ks noise.png\nmap_Ke -s 2 noise.png\nnewmtl b\nmap_Kd -o 1 noise.png\n",
           "usemtl a\nf 1/1 2/2 3/3\nusemtl b\nf 1/1 2/2 3/3\n");
  EXPECT_EQ(reads, 1);
  const auto first = [&](uint32_t r) { return scene.textures->words[r + HRT_TEXTURE_FIRST]; };
  EXPECT_EQ(first(record(scene, 0, HRT_MAP_DIFFUSE)), first(record(scene, 1, HRT_MAP_DIFFUSE)));
  EXPECT_NE(record(scene, 0, HRT_MAP_DIFFUSE), record(scene, 1, HRT_MAP_DIFFUSE)) << "other options";
}

TEST_F(LoadTextures, WhatCannotBeReadIsACheckerOrLeftOut) {
  const Scene scene =
      load("newmtl a\nmap_Kd torn.png\nmap_Ks torn.png\nKd .2 .3 .4\nnewmtl b\nmap_Ks gone.png\nmap_Kd gone.png\n",
           "usemtl a\nf 1/1 2/2 3/3\nusemtl b\nf 1/1 2/2 3/3\n");
  for (const uint32_t triangle : {0u, 1u}) {
    const uint32_t diffuse = record(scene, triangle, HRT_MAP_DIFFUSE);
    ASSERT_NE(diffuse, 0u);
    const uint32_t first = scene.textures->words[diffuse + HRT_TEXTURE_FIRST];
    EXPECT_NE(scene.textures->words[first], scene.textures->words[first + 8]) << "not all one colour";
  }
  EXPECT_EQ(record(scene, 0, HRT_MAP_SPECULAR), 0u);
  EXPECT_EQ(scene.material_of(0).ks, vec3(0)) << "nothing in its place";
  EXPECT_EQ(scene.material_of(0).kd, vec3(.2f, .3f, .4f));
  EXPECT_TRUE(warned(warnings, "1 textures cannot be used"));
  EXPECT_TRUE(warned(warnings, "torn.png: broken image"));
  EXPECT_TRUE(warned(warnings, "1 texture files are missing ('gone.png')"));
  EXPECT_EQ(std::count(scene.files.begin(), scene.files.end(), (folder.path / "torn.png").string()), 0);
}

TEST_F(LoadTextures, WhatIsDamagedIsDrawnAndTold) {
  const Scene scene = load("newmtl a\nmap_Kd grey.jpg\nnewmtl b\nmap_Kd grey2.jpg\n",
                           "usemtl a\nf 1/1 2/2 3/3\nusemtl b\nf 1/1 2/2 3/3\n");
  const uint32_t first = scene.textures->words[record(scene, 0, HRT_MAP_DIFFUSE) + HRT_TEXTURE_FIRST];
  EXPECT_EQ(scene.textures->words[first], texel_of(220, 220, 220)) << "no checker";
  EXPECT_EQ(warnings, (Warnings{{WarningCode::texture_damaged,
                                 "2 textures are cut short or damaged, and drawn as far as they can be read (first: " +
                                     (folder.path / "grey.jpg").string() + ": it ends too early)"}}));
}

TEST_F(LoadTextures, HolesOfAlphaAndOfMapD) {
  const Scene scene = load(
      "newmtl a\nmap_Kd leaf.png\nnewmtl b\nmap_Kd leaf.png\nmap_d mask.png\nnewmtl c\nmap_Kd noise.png\n"
      "newmtl d\nmap_d -mm 0.6 1 mask.png\nnewmtl e\nmap_d leaf.png\n",
      "usemtl a\nf 1/1 2/2 3/3\nusemtl b\nf 1/1 2/2 3/3\nusemtl c\nf 1/1 2/2 3/3\nusemtl d\nf 1/1 2/2 3/3\n"
      "usemtl e\nf 1/1 2/2 3/3\n");
  EXPECT_TRUE(scene.has_holes());
  const auto words = [&](uint32_t triangle, uint32_t field) {
    return scene.textures->words[record(scene, triangle, HRT_MAP_HOLES) + field];
  };
  EXPECT_EQ(record(scene, 0, HRT_MAP_HOLES), record(scene, 0, HRT_MAP_DIFFUSE));
  EXPECT_EQ(words(1, HRT_TEXTURE_WIDTH), 8u) << "map_d wins";
  EXPECT_EQ(scene.textures->words[words(1, HRT_TEXTURE_FIRST)] >> 24, 220u) << "its brightness";
  EXPECT_EQ(record(scene, 2, HRT_MAP_HOLES), 0u);
  EXPECT_EQ(record(scene, 3, HRT_MAP_HOLES), 0u) << "never under one half";
  EXPECT_EQ(words(4, HRT_TEXTURE_WIDTH), 32u);
  EXPECT_EQ(scene.textures->words[words(4, HRT_TEXTURE_FIRST) + 8 * 32 + 8] >> 24, 0u) << "its alpha";
  EXPECT_EQ(scene.material_of(0).opacity, 1) << "holes do not make the rest see-through";
}

TEST_F(LoadTextures, MissingCoordinatesAreToldOf) {
  const Scene scene = load("newmtl a\nmap_Kd noise.png\n", "usemtl a\nf 1/1 2/2 3/3\nf 1/1 2 3\nf 1 2 3\n");
  EXPECT_TRUE(warned(warnings, "2 triangles have a texture but not all of their texture coordinates"));
  const Textures& t = *scene.textures;
  EXPECT_EQ(t.texcoords[t.triangle_texcoords[1].y], vec2(0));
}

TEST_F(LoadTextures, MemoryIsBounded) {
  const string mtl = "newmtl a\nmap_Kd noise.png\nnewmtl b\nmap_Kd noise2.png\n",
               faces = "usemtl a\nf 1/1 2/2 3/3\nusemtl b\nf 1/1 2/2 3/3\n";
  const Scene both = load(mtl, faces);
  EXPECT_TRUE(warnings.empty());
  LoadWatch watch;
  watch.most_bytes = 16 * (both.textures->words.size() - 1);
  const Scene tight = load(mtl, faces, watch);
  EXPECT_TRUE(warned(warnings, "noise2.png: no memory is left"));
  EXPECT_NE(record(tight, 0, HRT_MAP_DIFFUSE), 0u);
}

// Ten pictures of 1 MB each to decode, of which 2.5 MB may be in work at a time; one asks for more than that.
TEST_F(LoadTextures, DecodingIsBounded) {
  constexpr uint64_t kEach = 1 << 20;
  string mtl, faces;
  for (int i = 0; i < 10; ++i) {
    folder.write(fmt::format("noise{}.png", i), "x");
    mtl += fmt::format("newmtl m{}\nmap_Kd noise{}.png\n", i, i);
    faces += fmt::format("usemtl m{}\nf 1/1 2/2 3/3\n", i);
  }
  folder.write("a.mtl", mtl);
  const string obj = folder.write("a.obj", kQuads + faces).string();
  std::atomic<uint64_t> now = 0, most = 0;
  LoadWatch watch;
  watch.most_bytes = 10 * kEach;
  watch.textures.size = [](const std::filesystem::path& path, int side, uint64_t most_texels) {
    const TexelImage image = pattern_named(path, side, most_texels);
    return TexelSize{image.width_px, image.height_px, path.filename() == "noise7.png" ? 3 * kEach : kEach};
  };
  watch.textures.read = [&](const std::filesystem::path& path, int side, uint64_t most_texels) {
    const uint64_t held = now += kEach;
    for (uint64_t seen = most; seen < held && !most.compare_exchange_weak(seen, held);) continue;
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
    now -= kEach;
    return pattern_named(path, side, most_texels);
  };
  ThreadPool pool(5);
  const Scene scene = load_scene(obj, pool, warnings, std::nullopt, watch);
  EXPECT_LE(most, 2 * kEach);
  ASSERT_EQ(warnings.size(), 1u);
  EXPECT_TRUE(warned(warnings, "1 textures cannot be used"));
  EXPECT_TRUE(warned(warnings, "noise7.png: decoding its 12x7 pixels takes 3.0 MiB of memory, but 2.5 MiB"));
}

TEST_F(LoadTextures, AFileThatChangesMeanwhileIsNotUsed) {
  folder.write("a.mtl", "newmtl a\nmap_Kd noise.png\n");
  const string obj = folder.write("a.obj", kQuads + "usemtl a\nf 1/1 2/2 3/3\n").string();
  LoadWatch watch;
  watch.textures = texel_files(pattern_named);
  watch.textures.read = [](const std::filesystem::path&, int side, uint64_t most) {
    return pattern_named("leaf.png", side, most);
  };
  ThreadPool pool(2);
  load_scene(obj, pool, warnings, std::nullopt, watch);
  EXPECT_TRUE(warned(warnings, "noise.png: changed while it was read"));
}

TEST_F(LoadTextures, TheSameForAnyThreads) {
  string mtl, faces;
  for (int i = 0; i < 20; ++i) {
    folder.write(fmt::format("noise{}.png", i), "x");
    mtl += fmt::format("newmtl m{}\nmap_Kd -imfchan {} noise{}.png\n", i, "rgbl"[i % 4], i);
    faces += fmt::format("usemtl m{}\nf 1/1 2/2 3/3\n", i);
  }
  const Scene one = load(mtl, faces, {}, 1), five = load(mtl, faces, {}, 5);
  EXPECT_EQ(one.textures->words, five.textures->words);
  EXPECT_EQ(one.textures->triangle_maps, five.textures->triangle_maps);
}

TEST_F(LoadTextures, UnreadableCoordinatesAreZero) {
  load("newmtl a\nmap_Kd noise.png\n", "vt nan 0\nvt 1e9 0\nvt\nvt 0.5\nusemtl a\nf 1/1 2/2 3/3\nf 1/4 2/5 3/7\n");
  EXPECT_TRUE(warned(warnings, "3 texture coordinates are not usable numbers and were set to 0 (first at line 9)"));
}

}  // namespace
}  // namespace hybridrt
