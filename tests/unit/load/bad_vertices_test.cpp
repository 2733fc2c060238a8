// A vertex without a position is left out if no face uses it, whatever the format; else the file is refused.

#include "core/load/bad_vertices.h"

#include "tests/support/mesh_test.h"

namespace hybridrt {
namespace {

using std::string;

const string kCorners[3] = {"0 0 0", "2 0 0", "0 2 0"};

string obj_with(const string& bad, const string& face) {
  string text;
  for (const string& corner : kCorners) text += "v " + corner + "\n";
  return text + "v " + bad + "\nf 1 2 3\n" + face;
}

string listed(const string& bad) {
  string text;
  for (const string& corner : kCorners) text += corner + "\n";
  return text + bad + "\n";
}

string ply_with(const string& bad, const string& face) {
  return "ply\nformat ascii 1.0\nelement vertex 4\nproperty double x\nproperty double y\nproperty double z\n"
         "element face " +
         string(face.empty() ? "1" : "2") + "\nproperty list uchar int vertex_indices\nend_header\n" + listed(bad) +
         "3 0 1 2\n" + face;
}

string off_with(const string& bad, const string& face) {
  return "OFF\n4 " + string(face.empty() ? "1" : "2") + " 0\n" + listed(bad) + "3 0 1 2\n" + face;
}

TEST(BadVertices, AreLeftOutIfNoFaceUsesThem) {
  for (const string bad : {"nan nan nan", "0 NaN 0", "-nan(ind) 0 0", "0 0 inf", "-Infinity 0 0", "0 1.#QNAN 0",
                           "1e31 0 0", "0 1e999 0"}) {
    const Loaded files[] = {load("a.obj", obj_with(bad, "")), load("a.ply", ply_with(bad, "")),
                            load("a.off", off_with(bad, ""))};
    for (const Loaded& loaded : files) {
      EXPECT_TRUE(warned(loaded.warnings, ": 1 vertices are NaN, infinite or not below 1e30 and were left out")) << bad;
      EXPECT_EQ(loaded.warnings.size(), 1u);
      EXPECT_EQ(loaded.scene.triangle_count(), 1u);
      EXPECT_EQ(loaded.scene.bounds.hi, vec3(2, 2, 0));
    }
  }
}

TEST(BadVertices, AreRefusedIfAFaceUsesThem) {
  for (const string corners :
       {"0 1 3", "3 0 1 2", "2 3 3"}) {  // a triangle, a polygon, a triangle that will be left out
    const string face = std::to_string((corners.size() + 1) / 2) + " " + corners + "\n";
    string obj_face = "f ";
    for (const char c : corners) obj_face += c == ' ' ? c : static_cast<char>(c + 1);
    EXPECT_TRUE(
        contains(failure("a.obj", obj_with("0 nan 0", obj_face)), "a.obj:4: vertex 4: its y coordinate is NaN"));
    EXPECT_TRUE(contains(failure("a.ply", ply_with("0 nan 0", face)), "vertex 3 (line 13): its y coordinate is NaN"));
    EXPECT_TRUE(contains(failure("a.off", off_with("0 nan 0", face)), "vertex 3 (line 6): its y coordinate is NaN"));
  }
  EXPECT_TRUE(contains(failure("a.obj", obj_with("0 0 -inf", "f 1 2 4\n")), "its z coordinate is infinite"));
  EXPECT_TRUE(contains(failure("a.obj", obj_with("1e30 0 0", "f 1 2 4\n")), "its x coordinate is not below 1e30"));
}

TEST(BadVertices, OfAnObjMayComeAfterTheFacesThatUseThem) {
  const string text = "f 1 2 4 3\nv 0 0 0\nv 2 0 0\nv 0 2 0\nv nan 1 1\n";
  EXPECT_TRUE(contains(error_of(text), "test.obj:5: vertex 4: its x coordinate is NaN"));
}

TEST(BadVertices, OfABinaryPlyAreCounted) {
  string text =
      "ply\nformat binary_little_endian 1.0\nelement vertex 1003\nproperty float x\nproperty float y\n"
      "property float z\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n";
  const string nan = bytes(std::numeric_limits<float>::quiet_NaN());
  for (int i = 0; i < 1000; ++i) text += nan + nan + nan;
  for (float value : {0, 0, 0, 1, 0, 0, 0, 1, 0}) text += bytes(value);
  const Loaded loaded = load("a.ply", text + '\3' + bytes(1000) + bytes(1001) + bytes(1002));
  EXPECT_TRUE(warned(loaded.warnings, "a.ply: 1000 vertices are NaN"));
  EXPECT_EQ(loaded.scene.bounds.hi, vec3(1, 1, 0));
  EXPECT_TRUE(contains(failure("a.ply", text + '\3' + bytes(1000) + bytes(1001) + bytes(7)), "vertex 7: its x"));
}

string facet(const string& third) {
  return "facet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex " + third + "\nendloop\nendfacet\n";
}

TEST(BadVertices, OfAnStlTakeTheirFacetWithThem) {
  const Loaded loaded = load("a.stl", "solid\n" + facet("0 1 0") + facet("0 nan 0") + "endsolid\n");
  EXPECT_TRUE(warned(loaded.warnings, "1 facets with a corner that is NaN, infinite or not below 1e30 were left out"));
  EXPECT_TRUE(warned(loaded.warnings, "(first at line 9)"));
  EXPECT_EQ(loaded.scene.triangle_count(), 1u);
  EXPECT_EQ(loaded.scene.positions.size(), 3u);
  EXPECT_TRUE(contains(failure("a.stl", "solid\n" + facet("0 0 inf") + "endsolid\n"),
                       "a.stl:2: its z coordinate is infinite, and no other facet is left"));
  EXPECT_TRUE(contains(failure("a.stl", "solid\n" + facet("0 0 q") + "endsolid\n"), "'q' is not a usable number"));
}

}  // namespace
}  // namespace hybridrt
