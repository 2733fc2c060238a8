// OpenMesh's format: what its files hold, and files that lie.

#include "core/load/om_chunks.h"
#include "core/load/om_io.h"
#include "tests/support/obj_test.h"

namespace hybridrt {
namespace {

using std::string;

template <typename Number>
string packed(std::initializer_list<Number> numbers) {
  string bytes;
  for (Number number : numbers) bytes.append(reinterpret_cast<const char*>(&number), sizeof number);
  return bytes;
}

string header(char kind, uint8_t version, uint32_t vertices, uint32_t faces, uint32_t edges) {
  return string("OM") + kind + static_cast<char>(version) + packed({vertices, faces, edges});
}

const string kPositions = packed<uint16_t>({0x1600}) + packed<float>({0, 0, 0, 1, 0, 0.25f, 0, 1, 0.5f, 1, 1, 0.75f});
const string kNormals = packed<uint16_t>({0x1620}) + packed<float>({0, 0, 2, 0, 0, 1, 0, 0, 1, 0, 0, 0});
const string kColors = packed<uint16_t>({0x1080}) + packed<uint8_t>({255, 0, 0, 0, 255, 0, 0, 0, 255, 255, 255, 255});
const string kEnd = packed<uint16_t>({0x001c});

/// Two triangles, (0, 1, 2) and (2, 1, 3), as OpenMesh 9 writes them: next, to and face of ten half-edges.
const string kHalfedges =
    packed<uint16_t>({0x16f8}) +
    packed<int8_t>({2, 1, 0, 5, 0, -1, 4, 2, 0, 6, 1, 1, 0, 0, 0, 9, 2, -1, 8, 3, 1, 1, 1, -1, 3, 2, 1, 7, 3, -1});
const string kFaces = packed<uint16_t>({0x06e8}) + packed<int8_t>({4, 8});
const string kWhole = header('T', 0x42, 4, 2, 5) + kPositions + kHalfedges + kFaces + kEnd;

struct Read {
  MeshData mesh;
  Warnings warnings;
};

Read read(const string& bytes) {
  const TemporaryFolder folder;
  Read found;
  found.mesh = read_om(folder.write("a.om", bytes), found.warnings);
  return found;
}

/// What reading it says; "" if it is read.
string refusal(const string& bytes) {
  try {
    read(bytes);
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::input);
    EXPECT_TRUE(contains(error.what(), "a.om")) << error.what();
    return error.what();
  }
  return "";
}

TEST(Om, FacesAsHalfedges) {
  const auto [mesh, warnings] = read(kWhole);
  EXPECT_EQ(warnings, Warnings());
  ASSERT_EQ(mesh.positions.size(), 4u);
  EXPECT_EQ(mesh.positions[3], dvec3(1, 1, 0.75));
  ASSERT_EQ(mesh.triangle_positions.size(), 2u);
  const auto has = [](uvec3 t, uint32_t a, uint32_t b, uint32_t c) {
    return t == uvec3(a, b, c) || t == uvec3(b, c, a) || t == uvec3(c, a, b);
  };
  EXPECT_TRUE(has(mesh.triangle_positions[0], 0, 1, 2));
  EXPECT_TRUE(has(mesh.triangle_positions[1], 2, 1, 3));
}

TEST(Om, FacesAsLists) {
  const string triangles = packed<uint16_t>({0x00e8}) + packed<uint8_t>({0, 1, 2, 2, 1, 3});
  EXPECT_EQ(read(header('T', 0x20, 4, 2, 0) + kPositions + triangles).mesh.triangle_positions,
            (std::vector<uvec3>{{0, 1, 2}, {2, 1, 3}}));
  const string polygon = packed<uint16_t>({0x40e8}) + packed<uint16_t>({4, 0, 1, 3, 2});
  EXPECT_EQ(read(header('P', 0x20, 4, 1, 0) + kPositions + polygon).mesh.triangle_positions.size(), 2u);
  // A third triangle at an edge, which no half-edge mesh can hold.
  const string fins = packed<uint16_t>({0x00e8}) + packed<uint8_t>({0, 1, 2, 2, 1, 3, 1, 2, 0});
  EXPECT_EQ(read(header('T', 0x20, 4, 3, 0) + kPositions + fins).mesh.triangle_positions.size(), 3u);
}

TEST(Om, NormalsAndColours) {
  const auto [mesh, warnings] =
      read(header('T', 0x42, 4, 2, 5) + kPositions + kNormals + kColors + kHalfedges + kFaces);
  EXPECT_EQ(warnings, Warnings());
  ASSERT_EQ(mesh.normals.size(), 4u);
  EXPECT_EQ(mesh.normals[0], vec3(0, 0, 1));
  EXPECT_EQ(mesh.normals[3], vec3(0));
  ASSERT_EQ(mesh.colors.size(), 4u);
  EXPECT_EQ(mesh.colors[1], vec3(0, 255, 0));
  EXPECT_EQ(mesh.color_full, 255);
}

TEST(Om, DoublePrecision) {
  const string positions = packed<uint16_t>({0x5600}) + packed<double>({0, 0, 0, 1e7 + 0.125, 0, 0, 0, 1, 0});
  const string triangle = packed<uint16_t>({0x00e8}) + packed<uint8_t>({0, 1, 2});
  EXPECT_EQ(read(header('T', 0x20, 3, 1, 0) + positions + triangle).mesh.positions[1].x, 1e7 + 0.125);
}

TEST(Om, WhatIsNotReadIsSaid) {
  const string texcoords = packed<uint16_t>({0x0e40}) + string(32, 0);
  const string status = packed<uint16_t>({0x0060}) + string(16, 0);
  const string property = packed<uint16_t>({0x00c2}) + "\4mine\6double" + packed<uint32_t>({3}) + "abc";
  const auto [mesh, warnings] =
      read(header('T', 0x42, 4, 2, 5) + kPositions + texcoords + status + kHalfedges + kFaces + property + kEnd);
  EXPECT_EQ(mesh.triangle_positions.size(), 2u);
  EXPECT_EQ(warnings.size(), 3u);
  EXPECT_TRUE(warned(warnings, "texture coordinates"));
  EXPECT_TRUE(warned(warnings, "properties"));
  EXPECT_TRUE(warned(warnings, "status"));
}

TEST(Om, WhatIsRefused) {
  EXPECT_TRUE(contains(refusal(""), "cut short"));
  for (size_t i : {1, 2}) {
    string other = kWhole;
    other[i] = 'F';
    EXPECT_TRUE(contains(refusal(other), "no OM file"));
  }
  EXPECT_TRUE(contains(refusal(header('T', 0x43, 4, 2, 5) + kPositions), "version 2.3"));
  EXPECT_TRUE(contains(refusal(header('T', 0x42, 4, 2, 5) + kPositions + kEnd), "no faces"));
  EXPECT_TRUE(contains(refusal(header('T', 0x42, 0, 2, 5) + kHalfedges + kFaces + kEnd), "no positions"));
  EXPECT_TRUE(contains(refusal(header('T', 0x42, 4, 2, 5) + kPositions + kPositions), "twice"));
  for (const auto& counts :
       {header('T', 0x42, 0xFFFFFFFF, 2, 5), header('T', 0x42, 4, 0xFFFFFFFF, 5), header('T', 0x42, 4, 2, 0xFFFFFFFF)})
    EXPECT_TRUE(contains(refusal(counts + kPositions + kHalfedges + kFaces), "cut short"));
  const string outside = packed<uint16_t>({0x00e8}) + packed<uint8_t>({0, 1, 4});
  EXPECT_NE(refusal(header('T', 0x20, 4, 1, 0) + kPositions + outside), "");
  string endless = kWhole;  // the first face's walk never comes back to its beginning
  endless[header('T', 0x42, 4, 2, 5).size() + kPositions.size() + 2 + 3 * 2] = 0;  // half-edge 2 leads back to 0
  EXPECT_TRUE(contains(refusal(endless), "no cycle"));
}

TEST(Om, NoChangedByteAndNoCutBreaksTheReader) {
  const string whole = header('T', 0x42, 4, 2, 5) + kPositions + kNormals + kColors + kHalfedges + kFaces + kEnd;
  for (size_t i = 0; i < whole.size(); ++i) {
    refusal(whole.substr(0, i));
    for (int bit = 0; bit < 8; ++bit) {
      string changed = whole;
      changed[i] = static_cast<char>(changed[i] ^ 1 << bit);
      refusal(changed);
    }
  }
}

TEST(Om, SeveralAtOnce) {
  const TemporaryFolder folder;
  std::vector<std::filesystem::path> paths;
  for (int i = 0; i < 8; ++i) paths.push_back(folder.write(fmt::format("m{}.om", i), kWhole));
  for (int round = 0; round < 40; ++round) {
    ThreadPool pool(4);
    Warnings warnings;
    ASSERT_EQ(load_meshes(paths, UpAxis::y, pool, warnings).triangle_count(), 16u);
  }
}

}  // namespace
}  // namespace hybridrt
