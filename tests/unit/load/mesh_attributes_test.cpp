// Colours and textures of PLY, OFF and STL.

#include <bit>
#include <cstring>

#include "core/image/srgb.h"
#include "core/load/mesh_io.h"
#include "core/load/text_scan.h"
#include "tests/support/obj_test.h"
#include "tests/support/textured_scenes.h"

namespace hybridrt {
namespace {

using std::string;

struct MeshAttributes : testing::Test {
  TemporaryFolder folder;
  Warnings warnings;

  Scene load(const string& name, const string& bytes) {
    LoadWatch watch;
    watch.textures = texel_files(pattern_named);
    ThreadPool pool(2);
    warnings.clear();
    const std::filesystem::path path = folder.write(name, bytes);
    return load_meshes({&path, 1}, UpAxis::y, pool, warnings, watch);
  }
  static vec3 color(const Scene& scene, uint32_t triangle, int corner) {
    return scene.colors.at(scene.triangle_colors.at(triangle)[corner]);
  }
  static vec2 texcoord(const Scene& scene, uint32_t triangle, int corner) {
    return scene.textures->texcoords.at(scene.textures->triangle_texcoords.at(triangle)[corner]);
  }
};

float linear(double display) { return static_cast<float>(linear_from_srgb(display)); }

/// A PLY of any format, from numbers as text: each value is written as the type that is named before it.
class PlyWriter {
 public:
  explicit PlyWriter(string format) : format_(std::move(format)) {}

  PlyWriter& add(const string& type, double value) {
    if (format_ == "ascii") {
      body_ += fmt::format("{} ", value);
    } else if (type == "uchar") {
      append(static_cast<uint8_t>(value));
    } else if (type == "int") {
      append(static_cast<int32_t>(value));
    } else {
      append(static_cast<float>(value));
    }
    return *this;
  }
  PlyWriter& floats(std::initializer_list<double> values) {
    for (double value : values) add("float", value);
    return *this;
  }
  void end_line() { body_ += format_ == "ascii" ? "\n" : ""; }
  string text(const string& header) const {
    return "ply\nformat " + format_ + " 1.0\n" + header + "end_header\n" + body_;
  }

 private:
  template <typename T>
  void append(T value) {
    string bytes(sizeof value, '\0');
    std::memcpy(bytes.data(), &value, sizeof value);
    if ((format_ == "binary_big_endian") != (std::endian::native == std::endian::big))
      bytes = {bytes.rbegin(), bytes.rend()};
    body_ += bytes;
  }

  string format_, body_;
};

const char* const kFormats[] = {"ascii", "binary_little_endian", "binary_big_endian"};
const string kXyz = "property float x\nproperty float y\nproperty float z\n";
const string kList = "property list uchar int vertex_indices\n";
const string kSquare[] = {"0 0 0", "2 0 0", "2 2 0", "0 2 0"};

string text_ply(const string& comments, const string& vertex, const std::vector<string>& of_vertices,
                const string& face, const std::vector<string>& faces) {
  string text = "ply\nformat ascii 1.0\n" + comments + "element vertex 4\n" + kXyz + vertex +
                fmt::format("element face {}\n", faces.size()) + kList + face + "end_header\n";
  for (size_t i = 0; i < 4; ++i) text += kSquare[i] + " " + (of_vertices.empty() ? "" : of_vertices[i]) + "\n";
  for (const string& corners : faces) text += corners + "\n";
  return text;
}

TEST_F(MeshAttributes, PlyColoursAndCornersTexturesInEveryFormat) {
  folder.write("noise.png", "x");
  for (const string format : kFormats) {
    SCOPED_TRACE(format);
    PlyWriter painted(format), textured(format);
    for (const double x : {0, 1, 2}) {
      painted.floats({x, x * x, 0}).add("uchar", 100 * x).add("uchar", 255).add("uchar", 0).end_line();
      textured.floats({x, x * x, 0}).end_line();
    }
    for (PlyWriter* ply : {&painted, &textured}) ply->add("uchar", 3).add("int", 0).add("int", 1).add("int", 2);
    textured.add("uchar", 6).floats({0, 0, .5, 1, .25, 0}).add("int", 0);
    const Scene colors =
        load("a.ply",
             painted.text("element vertex 3\n" + kXyz +
                          "property uchar red\nproperty uchar green\nproperty uchar blue\nelement face 1\n" + kList));
    for (int corner = 0; corner < 3; ++corner)
      EXPECT_EQ(color(colors, 0, corner), vec3(linear(100 * corner / 255.0), 1, 0));
    const Scene scene =
        load("b.ply", textured.text("comment TextureFile noise.png\nelement vertex 3\n" + kXyz + "element face 1\n" +
                                    kList + "property list uchar float texcoord\nproperty int texnumber\n"));
    EXPECT_TRUE(warnings.empty());
    ASSERT_TRUE(scene.textures);
    EXPECT_EQ(texcoord(scene, 0, 1), vec2(.5f, 1));
    EXPECT_EQ(texcoord(scene, 0, 2), vec2(.25f, 0));
    EXPECT_EQ(scene.files.back(), (folder.path / "noise.png").string());
  }
}

TEST_F(MeshAttributes, PlyColoursByTheirTypes) {
  const auto first = [&](const string& type, const string& numbers, const string& names = "red green blue") {
    string properties;
    std::string_view rest = names;
    for (std::string_view name = take_word(rest); !name.empty(); name = take_word(rest))
      properties += fmt::format("property {} {}\n", type, name);
    return color(load("a.ply", text_ply("", properties, {numbers, numbers, numbers, numbers}, "", {"3 0 1 2"})), 0, 0);
  };
  EXPECT_EQ(first("uchar", "1 0 255"), vec3(linear(1 / 255.0), 0, 1)) << "bytes, however small";
  EXPECT_EQ(first("ushort", "65535 0 0"), vec3(1, 0, 0));
  EXPECT_EQ(first("float", "1 0.5 0"), vec3(1, linear(.5), 0)) << "floats are sRGB too";
  EXPECT_EQ(first("float", "51 0 255"), vec3(linear(.2), 0, 1));
  EXPECT_EQ(first("int", "255 0 0"), vec3(1, 0, 0));
  EXPECT_EQ(first("uchar", "255 0 0", "diffuse_red diffuse_green diffuse_blue"), vec3(1, 0, 0));
  EXPECT_EQ(first("uchar", "255 0 0", "r g b"), vec3(1, 0, 0));
  EXPECT_TRUE(warnings.empty());
  EXPECT_EQ(first("uchar", "255 0 0 128", "red green blue alpha"), vec3(1, 0, 0));
  EXPECT_TRUE(warned(warnings, "4 colours have an alpha below 1, which is not read"));
}

TEST_F(MeshAttributes, PlyFacesKeepTheirColoursWhenTheyAreCut) {
  const string rgb = "property uchar red\nproperty uchar green\nproperty uchar blue\n";
  const Scene scene =
      load("a.ply", text_ply("", "", {}, rgb, {"4 0 1 2 3 255 0 0", "2 0 1 0 0 255", "3 0 2 1 0 255 0"}));
  ASSERT_EQ(scene.triangle_count(), 3u);
  for (int corner = 0; corner < 3; ++corner) {
    EXPECT_EQ(color(scene, 0, corner), vec3(1, 0, 0));
    EXPECT_EQ(color(scene, 1, corner), vec3(1, 0, 0));
    EXPECT_EQ(color(scene, 2, corner), vec3(0, 1, 0));
  }
  const std::vector<string> painted(4, "0 0 255"), white(4, "255 255 255"), faces{"3 0 1 2 255 0 0"};
  EXPECT_EQ(color(load("a.ply", text_ply("", rgb, painted, rgb, faces)), 0, 0), vec3(0, 0, 1));
  EXPECT_TRUE(warned(warnings, "the colours of its faces were left out, since its vertices have colours"));
  EXPECT_EQ(color(load("a.ply", text_ply("", rgb, white, rgb, faces)), 0, 0), vec3(1, 0, 0));
}

TEST_F(MeshAttributes, PlyTexturesOfVerticesAndOfSeveralFiles) {
  folder.write("noise.png", "x");
  folder.write("My Leaf.png", "x");
  const std::vector<string> places{"0 0", "1 0", "1 1", "0 nan"};
  for (const char* names : {"s t", "u v", "texture_u texture_v"}) {
    const string u(names, std::strchr(names, ' ')), v(std::strchr(names, ' ') + 1);
    const Scene scene =
        load("a.ply", text_ply("comment TextureFile noise.png\n",
                               "property float " + u + "\nproperty float " + v + "\n", places, "", {"4 0 1 2 3"}));
    ASSERT_TRUE(scene.textures) << names;
    EXPECT_EQ(scene.material_of(0).kd, vec3(1));
    EXPECT_EQ(warnings,
              (Warnings{{WarningCode::texcoord_unusable,
                         "a.ply: 1 texture coordinates are not usable numbers and were set to 0 (first at line 16)"}}));
  }
  const Scene several = load("a.ply", text_ply("comment TextureFile noise.png\ncomment TextureFile my leaf.png\n", "",
                                               {}, "property list uchar float texcoord\nproperty int texnumber\n",
                                               {"4 0 1 2 3 8 0 0 1 0 1 1 0 1 1", "3 0 1 2 6 0 0 1 0 1 1 0",
                                                "3 0 1 3 6 0 0 1 0 1 1 -1", "3 0 1 3 0 0"}));
  EXPECT_EQ(several.material_of(0).name, "my leaf.png");
  EXPECT_EQ(several.material_of(1).name, "my leaf.png");
  EXPECT_EQ(several.material_of(2).name, "noise.png");
  EXPECT_EQ(several.material_of(3).name, "default");
  for (uint32_t triangle = 0; triangle < 2; ++triangle)
    for (int corner = 0; corner < 3; ++corner)
      EXPECT_EQ(texcoord(several, triangle, corner), vec2(several.vertex(triangle, corner)) / 2.f) << "as they are cut";
  EXPECT_TRUE(warned(warnings, "1 texture names lead to no file as written"));
  EXPECT_TRUE(warned(warnings, "1 faces have a texnumber that no TextureFile comment has"));
  EXPECT_TRUE(warned(warnings, "1 triangles have a texture but not all of their texture coordinates"));
}

TEST_F(MeshAttributes, PlyFacesBeforeVerticesAndStripsHaveThemToo) {
  folder.write("noise.png", "x");
  const string head = "ply\nformat ascii 1.0\ncomment TextureFile noise.png\n",
               st = "property float s\nproperty float t\n";
  const string vertices = "element vertex 4\n" + kXyz;
  const Scene scene =
      load("a.ply", head + "element face 2\n" + kList + "property list uchar float texcoord\n" + vertices +
                        "end_header\n4 0 1 2 3 8 0 0 1 0 1 1 0 1\n3 0 1 2 6 0 0 .5 0 .5 .5\n"
                        "0 0 0\n2 0 0\n2 2 0\n0 2 0\n");
  EXPECT_TRUE(warnings.empty());
  for (uint32_t triangle = 0; triangle < 3; ++triangle)
    for (int corner = 0; corner < 3; ++corner)
      EXPECT_EQ(texcoord(scene, triangle, corner), vec2(scene.vertex(triangle, corner)) / (triangle < 2 ? 2.f : 4.f));
  const Scene painted =
      load("a.ply", "ply\nformat ascii 1.0\nelement face 2\n" + kList +
                        "property uchar red\nproperty uchar green\nproperty uchar blue\n" + vertices +
                        "end_header\n4 0 1 2 3 255 0 0\n3 0 1 2 0 255 0\n0 0 0\n2 0 0\n2 2 0\n0 2 0\n");
  EXPECT_EQ(color(painted, 1, 0), vec3(1, 0, 0));
  EXPECT_EQ(color(painted, 2, 0), vec3(0, 1, 0));
  const Scene strip = load("a.ply", head + vertices + st + "element tristrips 1\n" + kList +
                                        "end_header\n0 0 0 0 0\n2 0 0 1 0\n2 2 0 1 1\n0 2 0 0 1\n3 0 1 2\n");
  EXPECT_EQ(strip.material_of(0).name, "noise.png");
  EXPECT_EQ(texcoord(strip, 0, 1), vec2(1, 0));
}

TEST_F(MeshAttributes, PlyWhatStaysUnreadIsTold) {
  const string st = "property float s\nproperty float t\n";
  const std::vector<string> zeros(4, "0 0"), faces{"3 0 1 2"};
  load("a.ply", text_ply("", st, zeros, "", faces));
  EXPECT_TRUE(warned(warnings, "a.ply: texture coordinates were left out: no comment TextureFile names a texture"));
  load("a.ply", text_ply("comment TextureFile a.png\n", "", {}, "", faces));
  EXPECT_TRUE(warned(warnings, "the texture 'a.png' was left out: there are no texture coordinates"));
  load("a.ply", text_ply("comment TextureFile a.png\n", st, zeros, "", faces));
  EXPECT_TRUE(warned(warnings, "1 texture files are missing ('a.png') (first at line 3)"));
  load("a.ply", text_ply("", "property uchar red\n", {"1", "1", "1", "1"}, "", faces));
  EXPECT_TRUE(warned(warnings, "vertex colours are ignored: not all of red, green, blue are there"));
  const string text = text_ply("", "", {}, "", faces);
  const size_t end = text.find("end_header");
  load("a.ply", text.substr(0, end) + "element multi_texture_face 1\nproperty int x\n" + text.substr(end) + "1\n");
  EXPECT_TRUE(warned(warnings, "its elements 'multi_texture_face' are not read"));
}

TEST_F(MeshAttributes, OffColoursOfVerticesAndFaces) {
  const Scene vertices = load("a.off", "COFF\n3 1 0\n0 0 0 255 0 0 255\n1 0 0 0 51 0 255\n0 1 0 0 0 0\n3 0 1 2\n");
  EXPECT_EQ(color(vertices, 0, 0), vec3(1, 0, 0));
  EXPECT_EQ(color(vertices, 0, 1), vec3(0, linear(.2), 0));
  EXPECT_TRUE(warnings.empty());
  const Scene faces = load("a.off", "OFF\n4 3 0\n0 0 0\n1 0 0\n0 1 0\n1 1 1\n3 0 1 2 0.5 0 1\n3 0 2 1\n3 0 1 3 7\n");
  EXPECT_EQ(color(faces, 0, 2), vec3(linear(.5), 0, 1));
  EXPECT_EQ(color(faces, 1, 0), vec3(1));
  EXPECT_EQ(faces.material_of(1).name, "default") << "a face without a colour";
  EXPECT_TRUE(warned(warnings, "1 faces have colours that are not three or four numbers"));
}

string binary_stl(string header, const std::vector<uint16_t>& attributes) {
  header.resize(80);
  const auto append = [&](auto value) {
    string bytes(sizeof value, '\0');
    std::memcpy(bytes.data(), &value, sizeof value);
    header += std::endian::native == std::endian::big ? string(bytes.rbegin(), bytes.rend()) : bytes;
  };
  append(static_cast<uint32_t>(attributes.size()));
  for (const uint16_t attribute : attributes) {
    for (const float x : {0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0}) append(x);
    append(attribute);
  }
  return header;
}

TEST_F(MeshAttributes, StlColoursOfVisCam) {
  const Scene scene = load("a.stl", binary_stl("VisCAM", {0x8000 | 31 << 10, 0x8000 | 31, 0, 0x8000 | 31 << 10}));
  EXPECT_EQ(color(scene, 0, 1), vec3(1, 0, 0));
  EXPECT_EQ(color(scene, 1, 1), vec3(0, 0, 1));
  EXPECT_EQ(scene.material_of(2).name, "default");
  EXPECT_EQ(scene.triangle_colors[3], scene.triangle_colors[0]);
  EXPECT_FALSE(load("a.stl", binary_stl("", {31, 77})).has_colors()) << "bytes that say nothing of colours";
  EXPECT_TRUE(warnings.empty());
}

TEST_F(MeshAttributes, StlColoursStayWithTheirFacetsWhenOthersAreLeftOut) {
  string text = binary_stl("VisCAM", {0x8000 | 31, 0x8000 | 31 << 10});
  const float nan = std::numeric_limits<float>::quiet_NaN();
  std::memcpy(&text[84 + 12], &nan, 4);
  EXPECT_EQ(color(load("a.stl", text), 0, 1), vec3(1, 0, 0));
  EXPECT_TRUE(warned(warnings, "1 facets with a corner that is NaN"));
}

TEST_F(MeshAttributes, StlColoursOfMagics) {
  const string header("COLOR=\xFF\x00\x00\xFF,MATERIAL=", 20);
  const Scene scene = load("a.stl", binary_stl(header, {31 << 10, 31 << 5, 0x8000, 0xFFFF}));
  EXPECT_EQ(color(scene, 0, 1), vec3(0, 0, 1)) << "red is lowest";
  EXPECT_EQ(color(scene, 1, 1), vec3(0, 1, 0));
  EXPECT_EQ(color(scene, 2, 1), vec3(1, 0, 0)) << "the object's";
  EXPECT_EQ(color(scene, 3, 1), vec3(1, 0, 0));
  EXPECT_EQ(color(load("a.stl", binary_stl(header, {0, 0})), 1, 0), vec3(1, 0, 0)) << "no facet says anything";
  EXPECT_TRUE(warnings.empty());
}

}  // namespace
}  // namespace hybridrt
