// Broken OBJ files give an error that names the place, or a counted warning.

#include <random>

#include "tests/support/obj_test.h"

namespace hybridrt {
namespace {

using std::string;

TEST(ObjFaults, FilesThatAreNone) {
  ThreadPool pool(1);
  Warnings warnings;
  const TemporaryFolder folder;
  EXPECT_THROW(load_obj(folder.path / "missing.obj", pool, warnings), Error);
  EXPECT_THROW(load_obj(folder.path, pool, warnings), Error);
  EXPECT_TRUE(contains(error_of(""), "no faces"));
  EXPECT_TRUE(contains(error_of(kTriangle), "no faces (3 vertices)"));
  EXPECT_TRUE(contains(error_of(kTriangle + "f 1 2\n"), "none of its 1 faces"));
  EXPECT_TRUE(contains(error_of(kTriangle + "f 1 2 2\n"), "zero area"));
  EXPECT_TRUE(contains(error_of("v 0 1 0\nv 0 1 0\nv 0 1 0\nf 1 2 3\n"), "zero area")) << "all in one point";
}

TEST(ObjFaults, RandomBytesEndInAnError) {
  std::mt19937 random(7);
  for (int round = 0; round < 200; ++round) {
    string bytes(1 + random() % 5000, ' ');
    for (char& byte : bytes) byte = static_cast<char>(round % 2 ? random() : "vf 123/-.\n\\en#"[random() % 14]);
    if (round % 2 == 0) bytes += "\nf 0 0 0\n";  // random OBJ characters could be valid by chance
    EXPECT_NE(error_of(bytes), "");
  }
}

TEST(ObjFaults, NulBytesAndUtf16) {
  EXPECT_TRUE(contains(error_of(kTriangle + string("f 1 2 3\0\n", 9)), "test.obj:4: a NUL byte"));
  EXPECT_TRUE(contains(error_of(string("\xFF\xFEv\0 \0", 6)), "UTF-16"));
  EXPECT_TRUE(contains(error_of(string("\0v\0 ", 4)), "test.obj:1: a NUL byte"));
}

TEST(ObjFaults, EndlessLines) {
  EXPECT_TRUE(contains(error_of("v 0 0 0\n" + string(20 << 20, 'x')), "test.obj:2: a line longer than"));
  string continued = "v 0 0 0\nf";
  for (int i = 0; i < 3 << 20; ++i) continued += " 1\\\n";
  EXPECT_TRUE(contains(error_of(continued), "test.obj:2: a line longer than"));
}

TEST(ObjFaults, VerticesThatAreNoNumbers) {
  for (const string bad :
       {"nan", "NaN",  "-nan", "inf", "-Infinity", "1e39", "-1e39", "1e999", "1e99999999999", "0x10",
        "1,5", "1.0f", "1e",   "1e+", "-",         "+",    ".",     "1.2.3", "--1",           "abc"}) {
    const string message = error_of("v 0 0 0\nv 0 " + bad + " 0\nv 0 1 0\nf 1 2 3\n");
    EXPECT_TRUE(contains(message, "test.obj:2: vertex 2: its y coordinate")) << bad << ": " << message;
  }
  EXPECT_TRUE(contains(error_of("v 0 0 0\nv 1 2"), "test.obj:2: vertex 2 ends before its z coordinate"));
}

TEST(ObjFaults, FilesCutShort) {
  const string whole = kTriangle + "v 1 1 0\nf 1 2 3\nf 2 4 3";
  EXPECT_EQ(load_text(whole).scene.triangle_count(), 2u);
  for (size_t cut = 1; cut <= 4; ++cut)
    EXPECT_TRUE(contains(error_of(whole.substr(0, whole.size() - cut)), "test.obj:6: the file ends in the middle"));
  EXPECT_EQ(load_text(whole.substr(0, whole.size() - 7)).scene.triangle_count(), 1u) << "nothing to be seen of it";
}

TEST(ObjFaults, PositionIndicesOutOfRange) {
  for (const string bad : {"0", "-4", "4294967297", "2147483648", "-2147483649", "99999999999999999999", "0/1/1"})
    EXPECT_TRUE(
        contains(error_of(kTriangle + "f 1 2 " + bad + "\n"), "test.obj:4: face 1, corner 3: there is no vertex"))
        << bad;
  EXPECT_TRUE(contains(error_of(kTriangle + "f 1 2 3\nf 1 2 4\n"), "test.obj:5: a face uses vertex 4"));
  EXPECT_TRUE(contains(error_of(kTriangle + "f 1 2 4 3\n"), "test.obj:4: a face uses vertex 4"));
}

TEST(ObjFaults, CornersWithoutAVertex) {
  EXPECT_TRUE(
      contains(error_of(kTriangle + "f /1/1 2 3\n"), "test.obj:4: face 1, corner 1: '/1/1' has no vertex index"));
  for (const string bad : {"a", "1a", "1/2/3/4", "1.5", "1/x", "1//x", "-", "1\\2"})
    EXPECT_TRUE(contains(error_of(kTriangle + "f 1 2 " + bad + "\n"), "test.obj:4: face 1, corner 3")) << bad;
}

TEST(ObjFaults, BadAttributeIndicesAreLeftOutAndCounted) {
  const Loaded loaded = load_text(kTriangle + "vt 0 0\nvn 1 0 0\n" +
                                  "f 1/1/1 2/2/1 3/-2/1\n"       // two bad vt
                                  "f 1//1 2//0 3//4294967297\n"  // two bad vn
                                  "f 1/1/ 2// 3//3\n");          // one bad vn; empty ones do not count
  EXPECT_EQ(loaded.scene.triangle_count(), 3u);
  EXPECT_TRUE(warned(loaded.warnings, "2 texture coordinate indices lead nowhere"));
  EXPECT_TRUE(warned(loaded.warnings, "3 normal indices lead nowhere"));
  EXPECT_TRUE(warned(loaded.warnings, "first at line 6"));
  EXPECT_TRUE(warned(loaded.warnings, "first at line 7"));
  const auto normal = [&](int t, int k) { return loaded.scene.normals[loaded.scene.triangle_normals[t][k]]; };
  EXPECT_EQ(normal(0, 2), vec3(1, 0, 0));
  EXPECT_EQ(normal(1, 0), vec3(1, 0, 0));  // the good one is still there
  EXPECT_EQ(normal(1, 1), vec3(0, 0, 1));  // rebuilt
  EXPECT_EQ(normal(1, 2), vec3(0, 0, 1));
}

TEST(ObjFaults, AttributesMayFollowTheFaces) {
  const Loaded loaded = load_text(kTriangle + "f 1/1/1 2/1/1 3/1/2\nvt 0 0\nvn 1 0 0\n");
  EXPECT_TRUE(warned(loaded.warnings, "1 normal indices lead nowhere"));
  EXPECT_EQ(loaded.warnings.size(), 1u);
}

TEST(ObjFaults, ABadVertexNormalShiftsNoOther) {
  for (const string bad :
       {"vn 0 0 0", "vn nan 0 1", "vn 1 2", "vn", "vn inf 0 0", "vn a b c", "vn 1e-40 0 0", "vn 1e999 0 0"}) {
    const Loaded loaded = load_text(kTriangle + bad + "\nvn 2 0 0\nf 1//1 2//2 3//2\n");
    EXPECT_TRUE(warned(loaded.warnings, "1 corners had a zero or unreadable normal")) << bad;
    const uvec3 n = loaded.scene.triangle_normals[0];
    EXPECT_EQ(loaded.scene.normals[n[0]], vec3(0, 0, 1)) << bad;
    EXPECT_EQ(loaded.scene.normals[n[1]], vec3(1, 0, 0)) << bad;
  }
}

TEST(ObjFaults, DegenerateFacesAreLeftOutAndCounted) {
  const Loaded loaded = load_text(kTriangle + "v 2 0 0\nv 1 0 0\nf\nf 1\nf 1 2\nf 1 2 3\nf 1 1 2\nf 1 2 4\nf 1 2 5\n");
  ASSERT_EQ(loaded.scene.triangle_count(), 1u);
  EXPECT_EQ(loaded.scene.triangle_positions[0], uvec3(0, 1, 2));
  EXPECT_TRUE(warned(loaded.warnings, "test.obj: 3 faces of fewer than three corners were left out (first at line 6)"));
  EXPECT_TRUE(warned(loaded.warnings, "test.obj: 1 triangles that repeat a vertex were left out (first at line 10)"));
  EXPECT_TRUE(warned(loaded.warnings, "test.obj: 2 triangles of zero area were left out (first at line 11)"));
}

TEST(ObjFaults, UnknownStatementsAreCounted) {
  const Loaded loaded = load_text(kTriangle + "hello world\ncurv2 1 2\nf 1 2 3\n");
  EXPECT_TRUE(warned(loaded.warnings, "2 lines of an unknown kind were left out (first at line 4)"));
}

TEST(ObjFaults, ScenesBeyondSinglePrecision) {
  EXPECT_TRUE(contains(error_of("v 0 0 0\nv 1e20 0 0\nv 0 1 0\nf 1 2 3\n"), "scale it"));
  EXPECT_TRUE(contains(error_of("v 0 0 0\nv 1e-20 0 0\nv 0 1e-20 0\nf 1 2 3\n"), "scale it"));
}

}  // namespace
}  // namespace hybridrt
