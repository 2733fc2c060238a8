// An OBJ reads the same whatever chunks it is cut into, and however many threads read them.

#include "core/load/obj_parse.h"
#include "core/load/text_blocks.h"
#include "tests/support/obj_test.h"

namespace hybridrt {
namespace {

using std::string;

/// The result of reading, or the error that ends it.
struct Reading {
  MeshData data;
  Warnings warnings;
  string error;
};

Reading read_in_chunks(const std::filesystem::path& path, size_t chunk_bytes, int threads) {
  ThreadPool pool(threads);
  Reading reading;
  try {
    reading.data = parse_obj(path, pool, reading.warnings, nullptr, chunk_bytes);
  } catch (const Error& refused) {
    reading.error = refused.what();
  }
  return reading;
}

void expect_same(const Reading& a, const Reading& b) {
  EXPECT_EQ(a.error, b.error);
  if (!a.error.empty()) return;  // earlier warnings are lost
  EXPECT_EQ(a.warnings, b.warnings);
  EXPECT_EQ(a.data.positions, b.data.positions);
  EXPECT_EQ(a.data.normals, b.data.normals);
  EXPECT_EQ(a.data.triangle_positions, b.data.triangle_positions);
  EXPECT_EQ(a.data.triangle_normals, b.data.triangle_normals);
  EXPECT_EQ(a.data.texcoords, b.data.texcoords);
  EXPECT_EQ(a.data.colors, b.data.colors);
  EXPECT_EQ(a.data.color_full, b.data.color_full);
  EXPECT_EQ(a.data.triangle_texcoords, b.data.triangle_texcoords);
  EXPECT_EQ(a.data.triangle_materials, b.data.triangle_materials);
  EXPECT_EQ(a.data.triangle_places, b.data.triangle_places);
  EXPECT_EQ(a.data.material_names, b.data.material_names);
  EXPECT_EQ(a.data.libraries, b.data.libraries);
  EXPECT_EQ(a.data.faces, b.data.faces);
}

Reading expect_chunks_do_not_matter(const string& text) {
  const TemporaryFolder folder;
  const std::filesystem::path path = folder.write("test.obj", text);
  const Reading whole = read_in_chunks(path, kObjChunkBytes, 1);
  for (const size_t chunk_bytes : {1, 5, 16, 17, 40, 100})
    for (const int threads : {1, 3}) {
      SCOPED_TRACE(fmt::format("chunks of {}, {} threads", chunk_bytes, threads));
      expect_same(read_in_chunks(path, chunk_bytes, threads), whole);
    }
  return whole;
}

// Indices from both ends, polygons before their vertices, materials over many lines, continued lines, all repairable
// faults.
const string kEverything =
    "mtllib a.mtl\nf 1 2 3 4 5\nv 0 0 0\nv 4 0 0\nv 4 4 0\nv 2 1 0\nv 0 4 0\nusemtl red\nf -1 -2 -3\n"
    "f 1 2 3 4\nvn 0 0 1\nvn nan 0 0\nf 1//1 2//-1 3//2\nusemtl blue\nusemtl red\nf 1//3 2//9 3/7/0\n"
    "vt 0 0\n# C:\\\\\nf 1 \\\n 2 \\\n 3\nf 1 2\nf 5 4 3 2 \\\n1\nunknown thing\nvn 1 0 0\nusemtl  \nf 3 2 1\n"
    "usemtl green and blue\nmtllib b c.mtl\nf 1 3 2 5\nv 9 9 9\nf -1 1 2 -6 3";

TEST(ObjChunks, EverythingAtOnce) {
  const Reading whole = expect_chunks_do_not_matter(kEverything);
  EXPECT_EQ(whole.error, "");
  EXPECT_EQ(whole.data.faces, 11u);
  EXPECT_EQ(whole.data.triangle_positions.size(), 3 + 1 + 2 + 1 + 1 + 1 + 3 + 1 + 2 + 3u);
  EXPECT_EQ(whole.data.material_names, (std::vector<string>{"", "red", "blue", "green and blue"}));
  EXPECT_EQ(whole.data.libraries, (std::vector<string>{"a.mtl", "b c.mtl"}));
  EXPECT_EQ(whole.warnings.size(), 4u) << "a small face, a vt, a normal, an unknown line";
  EXPECT_EQ(whole.data.triangle_places.back(), 33u) << "lines are counted through";
}

// Colours that begin in the middle, and comments of ZBrush that belong to vertices by their order.
TEST(ObjChunks, Colours) {
  const Reading painted = expect_chunks_do_not_matter(
      "v 0 0 0\nv 1 0 0 1\nv 1 1 0 .5 0.25 1\nv 0 1 0 1 x 0\nv 0 2 0 0 0 1 1\nv 1 2 0\nf 1 2 3\n#MRGB ff000000\n");
  EXPECT_EQ(painted.data.colors,
            (std::vector<vec3>{vec3(-1), vec3(-1), vec3(.5f, .25f, 1), vec3(-1), vec3(0, 0, 1), vec3(-1)}));
  EXPECT_EQ(painted.warnings.size(), 2u) << "an x, and #MRGB beside colours of vertices";
  const Reading zbrush = expect_chunks_do_not_matter(
      "#File\nv 0 0 0\nv 1 0 0\n#MRGB ffFF0080ff00ff00\nv 0 1 0\n#MRGB 010203\n#MRGB fF0000fF \n#MRGBx\nf 1 2 3\n");
  EXPECT_EQ(zbrush.data.colors, (std::vector<vec3>{{255, 0, 128}, {0, 255, 0}, {0, 0, 255}}));
  EXPECT_EQ(zbrush.data.color_full, 255);
  EXPECT_EQ(zbrush.warnings.size(), 1u) << "a line of six digits";
}

TEST(ObjChunks, EndsOfLines) {
  for (const char* end : {"\r\n", "\r", "\n\n", "\n\r"}) {
    string text;
    for (char c : kEverything) text += c == '\n' ? string(end) : string(1, c);
    const Reading whole = expect_chunks_do_not_matter(text);
    EXPECT_EQ(whole.data.positions.size(), 6u);
  }
}

TEST(ObjChunks, TheFirstFaultCounts) {
  for (const char* fault : {"v 1 x 0", "v 1 2", "f 0 1 2", "f 1 2 99", "f -9 1 2", "f a", "f /1 2 3"}) {
    const Reading one = expect_chunks_do_not_matter(kEverything + "\n" + fault + "\n" + kTriangle + kTriangle);
    const Reading two = expect_chunks_do_not_matter(kEverything + "\n" + fault + "\nf 1 2 3\nf 0 0 0\nv z\n");
    EXPECT_TRUE(contains(one.error, ":34: ")) << one.error;
    const bool known_at_the_end = fault == string("f 1 2 99");
    EXPECT_TRUE(contains(two.error, known_at_the_end ? ":36: " : ":34: ")) << two.error;
  }
  const Reading nul = expect_chunks_do_not_matter(kEverything + "\n" + string("v 1\0 2 3\nv x\n", 13));
  EXPECT_TRUE(contains(nul.error, ":34: a NUL byte")) << nul.error;
}

TEST(ObjChunks, VerticesThatAreNoPositions) {
  const Reading unused = expect_chunks_do_not_matter(kEverything + "\nv 1 2 nan\nv 1e31 0 0\n" + kTriangle);
  EXPECT_EQ(unused.warnings.size(), 5u);
  const Reading used = expect_chunks_do_not_matter(kEverything + "\nv 1 2 nan\n" + kTriangle + "f 1 2 7 3\n");
  EXPECT_TRUE(contains(used.error, ":34: vertex 7: its z coordinate is NaN")) << used.error;
}

TEST(ObjChunks, AManyTimesLargerFileThanAChunk) {
  string text = kTriangle + "vn 0 0 1\n";
  for (int i = 0; i < 30'000; ++i) {
    text += fmt::format("v {} {}.5 -{}\nusemtl m{}\nf -1//1 1//1 2//1\n", i, i % 7, i % 11, i / 1000);
    if (i % 100 == 0) text += "f -1 -2 3 2 1\n";
  }
  const TemporaryFolder folder;
  const std::filesystem::path path = folder.write("test.obj", text);
  const Reading whole = read_in_chunks(path, size_t{1} << 30, 1);
  ASSERT_EQ(whole.error, "");
  EXPECT_EQ(whole.data.faces, 30'300u);
  EXPECT_EQ(whole.data.material_names.size(), 31u);
  for (const int threads : {1, 4}) {
    expect_same(read_in_chunks(path, 5'000, threads), whole);
    expect_same(read_in_chunks(path, 100'000, threads), whole);
  }
}

TEST(WholeLines, EndWithALinesEnd) {
  EXPECT_EQ(whole_lines("ab\ncd", LineJoin::none, true), 3u);
  EXPECT_EQ(whole_lines("ab\ncd\n", LineJoin::none, true), 6u);
  EXPECT_EQ(whole_lines("abcd", LineJoin::none, true), 0u);
  EXPECT_EQ(whole_lines("", LineJoin::none, true), 0u);
  EXPECT_EQ(whole_lines("ab\rcd\r", LineJoin::none, true), 3u) << "a newline may follow the second";
  EXPECT_EQ(whole_lines("ab\rcd\r", LineJoin::none, false), 6u);
  EXPECT_EQ(whole_lines("ab\r\ncd", LineJoin::none, true), 4u);
  EXPECT_EQ(whole_lines("v 1\nv 2 \\\n", LineJoin::obj, true), 4u) << "the last goes on";
  EXPECT_EQ(whole_lines("v 1\nv 2 \\\r\n3 \\\r\n", LineJoin::obj, true), 4u);
  EXPECT_EQ(whole_lines("v 1\nv 2 \\\n", LineJoin::none, true), 10u);
  EXPECT_EQ(whole_lines("v 1\n# C:\\\n", LineJoin::obj, true), 10u) << "comments never go on";
}

}  // namespace
}  // namespace hybridrt
