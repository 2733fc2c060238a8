#include "core/load/mesh_io.h"

#include "tests/support/mesh_test.h"

namespace hybridrt {
namespace {

using std::string;

string ply_head(const string& format, const string& vertex, const string& face, int vertices, int faces) {
  return "ply\nformat " + format + " 1.0\nelement vertex " + std::to_string(vertices) + "\n" + vertex +
         "element face " + std::to_string(faces) + "\n" + face + "end_header\n";
}
const string kXyz = "property float x\nproperty float y\nproperty float z\n";
const string kList = "property list uchar int vertex_indices\n";
const string kFour = "0 0 0\n2 0 0\n2 1 0\n0 1 0\n";

string text_ply(const string& vertices, const string& faces, int n, int m) {
  return ply_head("ascii", kXyz, kList, n, m) + vertices + faces;
}

TEST(Ply, ReadsTextAndCutsPolygons) {
  const Loaded loaded = load("a.ply", text_ply(kFour, "4 0 1 2 3\n", 4, 1));
  EXPECT_TRUE(loaded.warnings.empty());
  EXPECT_EQ(loaded.scene.triangle_count(), 2u);
  EXPECT_EQ(loaded.scene.positions.size(), 4u);
  EXPECT_EQ(loaded.scene.positions[1], vec3(2, 0, 0));
  EXPECT_EQ(loaded.scene.materials.size(), 1u);
  EXPECT_EQ(loaded.scene.materials[0].name, "default");
  EXPECT_EQ(loaded.scene.normals[loaded.scene.triangle_normals[0].x], vec3(0, 0, 1)) << "rebuilt";
}

TEST(Ply, ReadsEveryNumberTypeInBothByteOrders) {
  for (const bool big : {false, true}) {
    const string format = big ? "binary_big_endian" : "binary_little_endian";
    const auto file = [&](const char* xyz, const char* list, const auto& coordinate, const auto& count,
                          const auto& index) {
      string text = ply_head(format, string("property ") + xyz + " x\nproperty " + xyz + " y\nproperty " + xyz + " z\n",
                             string("property list ") + list + " vertex_index\n", 3, 1);
      for (int value : {0, 0, 0, 5, 0, 0, 0, 7, 0}) text += coordinate(value);
      text += count(3);
      for (int value : {0, 1, 2}) text += index(value);
      return text;
    };
    const auto as = [&]<typename T>(T) { return [big](int value) { return bytes(static_cast<T>(value), big); }; };
    for (const string& text : {file("float", "uchar int", as(0.f), as(uint8_t()), as(int32_t())),
                               file("double", "char uint", as(0.0), as(int8_t()), as(uint32_t())),
                               file("short", "ushort ushort", as(int16_t()), as(uint16_t()), as(uint16_t())),
                               file("int8", "uint32 int16", as(int8_t()), as(uint32_t()), as(int16_t())),
                               file("uint32", "int32 uint8", as(uint32_t()), as(int32_t()), as(uint8_t()))}) {
      const Loaded loaded = load("a.ply", text);
      EXPECT_TRUE(loaded.warnings.empty());
      ASSERT_EQ(loaded.scene.positions.size(), 3u);
      EXPECT_EQ(loaded.scene.positions[1], vec3(5, 0, 0));
      EXPECT_EQ(loaded.scene.positions[2], vec3(0, 7, 0));
    }
  }
}

TEST(Ply, KeepsPrecisionFarFromTheOrigin) {
  const Loaded loaded =
      load("a.ply", text_ply("10000000.125 0 0\n10000001.125 0 0\n10000000.125 1 0\n", "3 0 1 2\n", 3, 1));
  const Scene& scene = loaded.scene;
  EXPECT_EQ(scene.origin_world.x + scene.positions[0].x, 10000000.125);
  EXPECT_EQ(scene.positions[1] - scene.positions[0], vec3(1, 0, 0));
}

TEST(Ply, SkipsWhatItDoesNotKnowAndTakesNormals) {
  const string head = "ply\nformat ascii 1.0\ncomment made by hand\nelement vertex 3\n" + kXyz +
                      "property float nx\nproperty float ny\nproperty float nz\nproperty list uchar int tags\n"
                      "property uchar red\nelement thing 2\nproperty list uchar float f\nelement face 1\n"
                      "property uchar flag\n" +
                      kList + "property float quality\nend_header\n";
  const Loaded loaded = load("a.ply", head +
                                          "0 0 0 0 0 -2 2 7 7 255\n1 0 0 0 nan 1 0 255\n0 1 0 0 0 -1 1 9 255\n"
                                          "1 0.5\n0\n9 3 0 1 2 0.25\n");
  EXPECT_TRUE(warned(loaded.warnings, "vertex colours are ignored"));
  EXPECT_TRUE(warned(loaded.warnings, "1 corners had a zero or unreadable normal"));
  const Scene& scene = loaded.scene;
  EXPECT_EQ(scene.normals[scene.triangle_normals[0].x], vec3(0, 0, -1)) << "the file's, made unit";
  EXPECT_EQ(scene.normals[scene.triangle_normals[0].y], vec3(0, 0, 1)) << "rebuilt";
}

TEST(Ply, LosesNoFaceOfANonManifoldEdge) {
  const Loaded loaded =
      load("a.ply", text_ply("0 0 0\n1 0 0\n0 1 0\n0 -1 0\n0 0 1\n", "3 0 1 2\n3 1 0 3\n3 0 1 4\n3 0 1 2\n", 5, 4));
  EXPECT_EQ(loaded.scene.triangle_count(), 4u);
  EXPECT_EQ(loaded.scene.positions.size(), 5u);
}

TEST(Ply, NeedlesWhoseShortEdgeIsLostInRoundingHaveANormal) {
  const Loaded loaded = load("a.ply", text_ply("1e-41 0 0\n1e-41 1e-41 0\n1e-41 0.5 1\n", "3 0 1 2\n", 3, 1));
  for (int corner = 0; corner < 3; ++corner)
    EXPECT_EQ(loaded.scene.normals[loaded.scene.triangle_normals[0][corner]], vec3(1, 0, 0));
}

TEST(Ply, DegenerateFacesAreCountedAndLeftOut) {
  const Loaded loaded = load("a.ply", text_ply(kFour, "3 0 1 2\n2 0 1\n3 0 0 1\n0\n", 4, 4));
  EXPECT_EQ(loaded.scene.triangle_count(), 1u);
  EXPECT_TRUE(warned(loaded.warnings, "2 faces of fewer than three corners were left out (first at line 15)"));
  EXPECT_TRUE(warned(loaded.warnings, "1 triangles that repeat a vertex were left out (first at line 16)"));
}

TEST(Ply, RefusesWhatIsWrong) {
  const auto text = [](const string& vertices, const string& faces) {
    return failure("a.ply", text_ply(vertices, faces, 3, 1));
  };
  const string three = "0 0 0\n1 0 0\n0 1 0\n";
  EXPECT_TRUE(contains(text("0 0 0\nnan 0 0\n0 1 0\n", "3 0 1 2\n"), "vertex 1 (line 11): its x coordinate is NaN"));
  EXPECT_TRUE(contains(text("0 0 0\n1 -inf 0\n0 1 0\n", "3 0 1 2\n"), "its y coordinate is infinite"));
  EXPECT_TRUE(contains(text("0 0 0\n1 0 1e39\n0 1 0\n", "3 0 1 2\n"), "its z coordinate is not below 1e30"));
  EXPECT_TRUE(contains(text("0 0 0\n1 O 0\n0 1 0\n", "3 0 1 2\n"), "a.ply:11: 'O' is not a usable number"));
  EXPECT_TRUE(contains(text("0 0 0\n1 0\n0 1 0\n", "3 0 1 2\n"), "a.ply:11: the line has fewer numbers"));
  EXPECT_TRUE(contains(text(three, "3 0 1 3\n"), "a.ply:13: 3 is not the index of a vertex; there are 3"));
  EXPECT_TRUE(contains(text(three, "3 0 -1 2\n"), "-1 is not the index"));
  EXPECT_TRUE(contains(text(three, "3 0 1 4294967297\n"), "4294967297 is not the index"));
  EXPECT_TRUE(contains(text(three, "3 0 1 1.5\n"), "1.5 is not the index"));
  EXPECT_TRUE(contains(text(three, "-3 0 1 2\n"), "a list of -3 numbers"));
  EXPECT_TRUE(contains(text(three, ""), "cut short"));
  EXPECT_TRUE(contains(failure("a.ply", text_ply(three, "", 3, 0)), "has no faces (3 vertices)"));
  EXPECT_TRUE(contains(failure("a.ply", ""), "does not begin with 'ply'"));
  EXPECT_TRUE(contains(failure("a.ply", "v 0 0 0\nf 1 1 1\n"), "does not begin with 'ply'"));
  EXPECT_TRUE(contains(failure("a.ply", "ply\nformat ascii 1.0\n"), "header has no end"));
  EXPECT_TRUE(contains(failure("a.ply", "ply\nformat utf7 1.0\nend_header\n"), "a.ply:2: 'utf7' is not a PLY format"));
  EXPECT_TRUE(contains(failure("a.ply", "ply\nformat ascii 1.0\nelement vertex x\nend_header\n"), "a.ply:3: 'x'"));
  ThreadPool pool(1);
  Warnings warnings;
  for (const std::filesystem::path path : {"/nonexistent/a.ply", "/nonexistent/a.off", "/nonexistent/a.stl"})
    EXPECT_THROW(load_meshes({&path, 1}, UpAxis::y, pool, warnings), Error) << path;
}

TEST(Ply, HeadersThatLieCostNoMemory) {
  const string lie = "element face 4000000000\n";
  string text = text_ply(kFour, "3 0 1 2\n", 4, 1);
  text.replace(text.find("element face 1\n"), 15, lie);
  EXPECT_TRUE(contains(failure("a.ply", text), "the header promises 4000000000 elements 'face'"));
  // A list that promises more corners than there are bytes.
  string binary = ply_head("binary_little_endian", kXyz, "property list uint int vertex_indices\n", 3, 1);
  for (float value : {0, 0, 0, 1, 0, 0, 0, 1, 0}) binary += bytes(value);
  EXPECT_TRUE(contains(failure("a.ply", binary + bytes(1000000u) + bytes(0)), "cut short"));
  EXPECT_TRUE(contains(failure("a.ply", binary + bytes(4000000000u) + bytes(0)), "a list of 4e+09 numbers"));
  for (size_t keep = binary.size(); keep > binary.size() - 36; keep -= 5)
    EXPECT_TRUE(contains(failure("a.ply", binary.substr(0, keep)), "cut short")) << keep;
}

TEST(Off, ReadsKindsCommentsAndColours) {
  for (const string& text :
       {"OFF\n# four corners\n4 1 0\n\n" + kFour + "4 0 1 2 3\n", "OFF 4 1 4\n" + kFour + "4 0 1 2 3"}) {
    const Loaded loaded = load("a.off", text);
    EXPECT_TRUE(loaded.warnings.empty());
    EXPECT_EQ(loaded.scene.triangle_count(), 2u);
  }
  const Loaded colored = load("a.off",
                              "CNOFF\n3 1 0\n0 0 0 0 0 -3 1 1 1 1\n1 0 0 0 0 -1 1 1 1 1\n0 1 0 0 0 -1 1 1 1 1\n"
                              "3 0 1 2 255 0 0 # red\n");
  EXPECT_TRUE(colored.warnings.empty());
  EXPECT_EQ(colored.scene.colors.at(colored.scene.triangle_colors.at(0).y), vec3(1, 0, 0))
      << "the face's, as all vertices are white";
  EXPECT_EQ(colored.scene.normals[colored.scene.triangle_normals[0].x], vec3(0, 0, -1));
}

TEST(Off, RefusesWhatIsWrong) {
  EXPECT_TRUE(contains(failure("a.off", ""), "cut short: it ends before the keyword OFF"));
  EXPECT_TRUE(contains(failure("a.off", "solid\n"), "'solid' is not the keyword OFF"));
  EXPECT_TRUE(contains(failure("a.off", "nOFF 4\n1 1 1\n0 0 0 0\n"), "4 dimensions; only three can be drawn"));
  EXPECT_TRUE(contains(failure("a.off", "OFF BINARY\n1 1 1\n"), "binary OFF is not read"));
  EXPECT_TRUE(contains(failure("a.off", "OFF\n4000000000 1 0\n"), "is not a count"));
  EXPECT_TRUE(contains(failure("a.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n"), "it ends before the last vertex"));
  EXPECT_TRUE(contains(failure("a.off", "OFF\n3 1 0\n0 0 0\n1 nan 0\n0 1 0\n3 0 1 2\n"),
                       "vertex 1 (line 4): its y coordinate is NaN"));
  EXPECT_TRUE(contains(failure("a.off", "OFF\n3 1 0\n0 0 0\n1 1e30 0\n0 1 0\n3 0 1 2\n"), "its y coordinate"));
  EXPECT_TRUE(contains(failure("a.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 3\n"), "a.off:6: 3 is not the index"));
  EXPECT_TRUE(contains(failure("a.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1\n"), "a.off:6: a number is missing"));
  EXPECT_TRUE(contains(failure("a.off", string("OFF\0\n", 5)), "NUL"));
}

const string kFacet =
    "facet normal 0 0 1\n outer loop\n  vertex 0 0 0\n  vertex 1 0 0\n  vertex 0 1 0\n endloop\nendfacet\n";

string binary_stl(uint32_t promised, int facets) {
  string text = "solid, though it is binary" + string(54, ' ') + bytes(promised);
  for (int i = 0; i < facets; ++i) {
    for (float value : {9, 9, 9, 0, 0, 0, 1, 0, 0, 0, 1, 0}) text += bytes(value);
    text += string(2, '\1');
  }
  return text;
}

TEST(Stl, ReadsTextAndBinary) {
  const Loaded text = load("a.stl", "solid my vertex\n" + kFacet + "endsolid\nsolid b\n" + kFacet + "endsolid b\n");
  const Loaded binary = load("a.STL", binary_stl(2, 2));
  for (const Loaded* loaded : {&text, &binary}) {
    EXPECT_TRUE(loaded->warnings.empty());
    EXPECT_EQ(loaded->scene.triangle_count(), 2u);
    EXPECT_EQ(loaded->scene.vertex(1, 1), vec3(1, 0, 0));
    EXPECT_EQ(loaded->scene.normals[loaded->scene.triangle_normals[0].x], vec3(0, 0, 1)) << "of the geometry";
  }
  string upper = kFacet;
  for (char& c : upper) c = static_cast<char>(std::toupper(c));
  EXPECT_EQ(load("a.stl", "SOLID X\n" + upper + "ENDSOLID\n").scene.triangle_count(), 1u);
}

TEST(Stl, RefusesWhatIsWrongAndSaysWhatItLeftOut) {
  EXPECT_TRUE(contains(failure("a.stl", ""), "is empty"));
  EXPECT_TRUE(contains(failure("a.stl", "solid a\nendsolid\n"), "has no faces"));
  EXPECT_TRUE(contains(failure("a.stl", binary_stl(3, 2)), "a binary STL of 3 facets, but there is room for 2"));
  EXPECT_TRUE(contains(failure("a.stl", binary_stl(4000000000u, 1)), "room for 1"));
  EXPECT_TRUE(contains(failure("a.stl", "random bytes"), "a.stl:1: 'random' is not a statement of an STL file"));
  EXPECT_TRUE(contains(failure("a.stl", "solid a\nfacet normal 0 0 1\nvertex 0 0 q\n"), "a.stl:3: 'q'"));
  EXPECT_TRUE(contains(failure("a.stl", "solid a\n" + kFacet.substr(0, 60)), "a.stl:2: cut short"));
  EXPECT_TRUE(contains(failure("a.stl", "solid a\nvertex 0 0 0\n"), "outside of any facet"));
  EXPECT_TRUE(contains(failure("a.stl", "solid a\n" + kFacet + "wat\n"), "'wat' is not a statement"));
  EXPECT_TRUE(warned(load("a.stl", binary_stl(1, 2)).warnings, "50 bytes behind its 1 facets were ignored"));
  string flat = kFacet;
  flat.replace(flat.find("0 1 0"), 5, "2 0 0");
  EXPECT_TRUE(warned(load("a.stl", "solid a\n" + kFacet + flat + "endsolid\n").warnings,
                     "1 triangles of zero area were left out (first at line 9)"));
}

TEST(Meshes, SeveralFilesBecomeOneScene) {
  const TemporaryFolder folder;
  folder.write("a.mtl", "newmtl red\nKd 1 0 0\n");
  const std::filesystem::path paths[] = {
      folder.write("a.obj",
                   "mtllib a.mtl\nv 1e7 0 0\nv 10000001 0 0\nv 1e7 1 0\nvn 0 0 -1\nusemtl red\nf 1//1 2//1 3//1\n"),
      folder.write("b.ply", text_ply("10000002 0 0\n10000003 0 0\n10000002 1 0\n", "3 0 1 2\n", 3, 1)),
      folder.write("c.obj", "mtllib a.mtl\nv 10000004 0 0\nv 10000005 0 0\nv 10000004 1 0\nusemtl red\nf 1 2 3\n")};
  ThreadPool pool(3);
  Warnings warnings;
  const Scene scene = load_meshes(paths, UpAxis::y, pool, warnings);
  EXPECT_TRUE(warnings.empty());
  ASSERT_EQ(scene.triangle_count(), 3u);
  for (uint32_t t = 0; t < 3; ++t)
    EXPECT_EQ(scene.origin_world + dvec3(scene.vertex(t, 0)), dvec3(1e7 + 2 * t, 0, 0)) << "one origin";
  EXPECT_EQ(scene.material_of(0).name, "red");
  EXPECT_EQ(scene.material_of(1).name, "default");
  EXPECT_EQ(scene.material_of(2).name, "red");
  EXPECT_EQ(scene.materials[0].name, "default");
  EXPECT_EQ(scene.normals[scene.triangle_normals[0].x], vec3(0, 0, -1)) << "the file's";
  EXPECT_EQ(scene.normals[scene.triangle_normals[1].x], vec3(0, 0, 1)) << "rebuilt";
}

TEST(Meshes, UpAxisZIsAnExactQuarterTurn) {
  const string obj = "v 0 0 0\nv 0.1 0.2 0.3\nv 0 1 0\nvn 0 0 1\nf 1//1 2//1 3//1\n";
  const Scene y = load("a.obj", obj).scene, z = load("a.obj", obj, UpAxis::z).scene;
  for (size_t i = 0; i < 3; ++i) {
    const vec3 p = y.positions[i];
    EXPECT_EQ(z.positions[i], vec3(p.x, p.z, -p.y));
  }
  EXPECT_EQ(z.normals[0], vec3(0, 1, 0));
}

}  // namespace
}  // namespace hybridrt
