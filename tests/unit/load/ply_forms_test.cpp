// PLY as scanners' archives and other programs write it.

#include "core/load/mesh_io.h"
#include "tests/support/mesh_test.h"

namespace hybridrt {
namespace {

using std::string;

/// Writes numbers as text or in either byte order.
struct Writer {
  string format;
  string text;

  template <typename T>
  void add(T value) {
    if (format == "ascii")
      text += std::to_string(value) + " ";
    else
      text += bytes(value, format == "binary_big_endian");
  }
  void end_element() {
    if (format == "ascii") text += "\n";
  }
};

const char* const kFormats[] = {"ascii", "binary_little_endian", "binary_big_endian"};
const string kVertexElement = "element vertex 6\nproperty float x\nproperty float y\nproperty float z\n";

void add_vertices(Writer& file) {  // two rows of three
  for (int i = 0; i < 6; ++i, file.end_element()) {
    file.add(static_cast<float>(i / 2));
    file.add(static_cast<float>(i % 2));
    file.add(0.f);
  }
}

/// The two rows as strips of `Index`.
template <typename Index>
Loaded load_strips(const string& format, const char* type, const std::vector<std::vector<int64_t>>& lists) {
  Writer file{format, "ply\nformat " + format + " 1.0\n" + kVertexElement + "element tristrips " +
                          std::to_string(lists.size()) + "\nproperty list int " + type +
                          " vertex_indices\nend_header\n"};
  add_vertices(file);
  for (const auto& list : lists) {
    file.add(static_cast<int32_t>(list.size()));
    for (const int64_t index : list) file.add(static_cast<Index>(index));
    file.end_element();
  }
  return load("a.ply", file.text);
}

void expect_strip(const Loaded& loaded) {
  EXPECT_TRUE(loaded.warnings.empty());
  ASSERT_EQ(loaded.scene.triangle_count(), 4u);
  for (const uvec3& t : loaded.scene.triangle_positions) {
    const dvec3 a(loaded.scene.positions[t.x]), b(loaded.scene.positions[t.y]), c(loaded.scene.positions[t.z]);
    EXPECT_EQ(glm::cross(b - a, c - a), dvec3(0, 0, -1)) << "every triangle faces the same way";
  }
}

TEST(PlyForms, TriangleStrips) {
  for (const string format : kFormats) {
    expect_strip(load_strips<int32_t>(format, "int", {{0, 1, 2, 3, 4, 5}}));
    expect_strip(load_strips<int32_t>(format, "int", {{0, 1, 2, 3, -1, 2, 3, 4, 5}}));
    expect_strip(load_strips<int32_t>(format, "int", {{0, 1, 2, 3, -1, -1, 2, 3, 4, 5, -1}}));
    expect_strip(load_strips<int32_t>(format, "int", {{0, 1, 2, 3}, {}, {2, 3, 4, 5}}));
    expect_strip(load_strips<int32_t>(format, "int", {{0, 1, 2, 3, 3, 2, 2, 3, 4, 5}}));  // joined by repeated corners
    expect_strip(load_strips<uint32_t>(format, "uint", {{0, 1, 2, 3, 0xFFFFFFFF, 2, 3, 4, 5}}));
    expect_strip(load_strips<uint16_t>(format, "ushort", {{0, 1, 2, 3, 0xFFFF, 2, 3, 4, 5}}));
    const Loaded odd = load_strips<int32_t>(format, "int", {{1, 3, 2, -1, 0, 1, 2, -1, 0, 1}});
    EXPECT_EQ(odd.scene.triangle_positions[0], uvec3(1, 3, 2)) << "a new strip starts the other way round";
    EXPECT_EQ(odd.scene.triangle_positions[1], uvec3(0, 1, 2));
    EXPECT_TRUE(warned(odd.warnings, "1 faces of fewer than three corners were left out"));
  }
}

TEST(PlyForms, AStripListMayBeLongerThanAnyPolygon) {
  std::vector<int64_t> list;
  for (int i = 0; i < 1 << 19; ++i) list.insert(list.end(), {0, 1, 2, -1});
  EXPECT_EQ(load_strips<int32_t>("binary_big_endian", "int", {list}).scene.triangle_count(), size_t{1} << 19);
}

TEST(PlyForms, FaultyStripsAreRefused) {
  const string head = "ply\nformat ascii 1.0\n" + kVertexElement + "element tristrips 1\n";
  const string vertices = "0 0 0\n0 1 0\n1 0 0\n1 1 0\n2 0 0\n2 1 0\n", list = "property list int int vertex_indices\n";
  EXPECT_TRUE(
      contains(failure("a.ply", head + list + "end_header\n" + vertices + "4 0 1 2 6\n"), "6 is not the index"));
  EXPECT_TRUE(
      contains(failure("a.ply", head + list + "end_header\n" + vertices + "4 0 1 2 -2\n"), "-2 is not the index"));
  EXPECT_TRUE(contains(failure("a.ply", head + list + "end_header\n" + vertices + "5 0 1 2\n"), "fewer numbers"));
  EXPECT_TRUE(contains(failure("a.ply", head + list + "end_header\n" + vertices + "4000000000 0 1\n"), "does not fit"));
  EXPECT_TRUE(
      contains(failure("a.ply", head + "property int n\nend_header\n" + vertices + "3\n"), "its strips have no list"));
}

TEST(PlyForms, FacesBeforeVertices) {
  for (const string format : kFormats) {
    Writer file{format, "ply\nformat " + format + " 1.0\nelement face 3\nproperty list uchar int vertex_indexes\n" +
                            "element tristrips 1\nproperty list int int vertex_indices\n" + kVertexElement +
                            "end_header\n"};
    for (const std::vector<int>& face : {std::vector{0, 2, 4, 5, 3, 1}, std::vector{0, 1}, std::vector{0, 2, 1}}) {
      file.add(static_cast<uint8_t>(face.size()));
      for (const int corner : face) file.add(corner);
      file.end_element();
    }
    for (const int number : {3, 3, 4, 5}) file.add(number);
    file.end_element();
    add_vertices(file);
    const Loaded loaded = load("a.ply", file.text);
    EXPECT_TRUE(warned(loaded.warnings, "1 faces of fewer than three corners"));
    EXPECT_EQ(loaded.scene.triangle_count(), 6u) << "a hexagon, a triangle and a strip";
    EXPECT_EQ(loaded.scene.bounds.hi, vec3(2, 1, 0));
  }
}

TEST(PlyForms, NamesInAnyCase) {
  const Loaded loaded = load("a.ply",
                             "ply\nformat ASCII 1.0\nELEMENT Vertex 3\nproperty Float X\nproperty FLOAT Y\n"
                             "property float Z\nproperty float NX\nproperty float NY\nproperty float NZ\n"
                             "property uchar Red\nelement FACE 1\nproperty LIST uchar int Vertex_Index\nEND_HEADER\n"
                             "0 0 0 0 0 -1 9\n1 0 0 0 0 -1 9\n0 1 0 0 0 -1 9\n3 0 1 2\n");
  EXPECT_TRUE(warned(loaded.warnings, "vertex colours are ignored"));
  EXPECT_EQ(loaded.scene.positions[1], vec3(1, 0, 0));
  EXPECT_EQ(loaded.scene.normals[loaded.scene.triangle_normals[0].x], vec3(0, 0, -1));
}

}  // namespace
}  // namespace hybridrt
