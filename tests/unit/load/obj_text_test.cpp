// All ways to write the same OBJ must read the same.

#include <clocale>
#include <locale>

#include "tests/support/obj_test.h"

namespace hybridrt {
namespace {

using std::string;

const string kSquare = "v 0 0 0\nv 1.5 0 0\nv 1.5 1 0\nv 0 1 -0.25\nf 1 2 3\nf 1 3 4\n";

void expect_same(const Scene& a, const Scene& b) {
  EXPECT_EQ(a.positions, b.positions);
  EXPECT_EQ(a.triangle_positions, b.triangle_positions);
  EXPECT_EQ(a.normals, b.normals);
}

string replaced(string text, const string& from, const string& to) {
  for (size_t at = 0; (at = text.find(from, at)) != text.npos; at += to.size()) text.replace(at, from.size(), to);
  return text;
}

TEST(ObjText, ReadsThePlainForm) {
  const Loaded loaded = load_text(kSquare);
  EXPECT_TRUE(loaded.warnings.empty());
  ASSERT_EQ(loaded.scene.positions.size(), 4u);
  EXPECT_EQ(loaded.scene.positions[3], vec3(0, 1, -0.25f));
  ASSERT_EQ(loaded.scene.triangle_count(), 2u);
  EXPECT_EQ(loaded.scene.triangle_positions[1], uvec3(0, 2, 3));
  EXPECT_EQ(loaded.scene.materials.at(0).name, "default");
}

TEST(ObjText, LineEndsAndByteOrderMarkDoNotMatter) {
  const Scene plain = load_text(kSquare).scene;
  const string crlf = replaced(kSquare, "\n", "\r\n");
  for (const string& text :
       {crlf, replaced(kSquare, "\n", "\r"), replaced(kSquare, "\n", "\n\n"), "\xEF\xBB\xBF" + kSquare,
        "\xEF\xBB\xBF" + crlf, kSquare.substr(0, kSquare.size() - 1), crlf.substr(0, crlf.size() - 2),
        replaced(kSquare, " ", "\t  "), replaced(kSquare, "\n", " \t\n\t"), replaced(kSquare, "v ", "v +")}) {
    const Loaded loaded = load_text(text);
    expect_same(loaded.scene, plain);
    EXPECT_TRUE(loaded.warnings.empty());
  }
}

TEST(ObjText, JoinsContinuedLines) {
  const Scene plain = load_text(kSquare).scene;
  expect_same(load_text(replaced(kSquare, "1.5 ", "1.5 \\\n")).scene, plain);
  expect_same(load_text(replaced(kSquare, "f 1", "f \\\r\n1\\\r\n")).scene, plain);
  expect_same(load_text(kSquare + "\\").scene, plain);
}

TEST(ObjText, BackslashesThatEndCommentsAndNamesSwallowNothing) {
  const Scene plain = load_text(kSquare).scene;
  expect_same(load_text("# C:\\models\\\n" + kSquare).scene, plain);
  expect_same(load_text("o C:\\models\\\n" + kSquare).scene, plain);
  expect_same(load_text("g a\\\n" + kSquare).scene, plain);
}

TEST(ObjText, BlocksMayEndAnywhere) {
  // A block is 1 MiB: let each byte of "\r\nv" fall on its end.
  const Scene plain = load_text(kSquare).scene;
  for (int shift = 0; shift < 12; ++shift) {
    string text(static_cast<size_t>(1 << 20) - 4 - shift, '#');
    text += "\r\n";
    expect_same(load_text(text + replaced(kSquare, "\n", "\r\n")).scene, plain);
  }
}

TEST(ObjText, NegativeAndForwardIndicesMeanTheSame) {
  const Scene plain = load_text(kSquare).scene;
  expect_same(load_text("v 0 0 0\nv 1.5 0 0\nv 1.5 1 0\nf -3 -2 -1\nv 0 1 -0.25\nf -4 -2 -1\n").scene, plain);
  expect_same(load_text("f 1 2 3\nf 1 3 4\nv 0 0 0\nv 1.5 0 0\nv 1.5 1 0\nv 0 1 -0.25\n").scene, plain);
}

TEST(ObjText, PolygonsMayComeBeforeTheirVertices) {
  const string face = "f 1 2 3 4 5 6\n", other = "f 1 2 3\n";
  const string vertices = "v 0 0 0\nv 4 0 0\nv 4 4 0\nv 2 1 0\nv 1 4 0\nv 0 4 0\n";
  const Scene after = load_text(vertices + face + other).scene, before = load_text(face + other + vertices).scene;
  EXPECT_EQ(after.triangle_count(), 5u);
  expect_same(before, after);
}

TEST(ObjText, IgnoresWhatIsNotDrawn) {
  const Loaded loaded = load_text(
      "o a b\ng c d\ns 1\nv 0 0 0 1 0 0\nv 1 0 0 0.5 0.5 0.5\nv 0 1 0 1 1 1\n"
      "vt 0 0\np 1 2\nl 1 2 3\nvp 1 2\nf 1/1 2/1 3/1\n");
  EXPECT_EQ(loaded.scene.triangle_count(), 1u);
  EXPECT_TRUE(loaded.warnings.empty());
}

TEST(ObjText, TheLocaleDoesNotMatter) {
  struct Comma : std::numpunct<char> {
    char do_decimal_point() const override { return ','; }
    char do_thousands_sep() const override { return '.'; }
    string do_grouping() const override { return "\3"; }
  };
  const Scene plain = load_text(kSquare).scene;
  const std::locale before = std::locale::global(std::locale(std::locale::classic(), new Comma));
  const string c_before = std::setlocale(LC_NUMERIC, nullptr);
  std::setlocale(LC_NUMERIC, "de_DE.UTF-8");  // if it is installed
  const Scene german = load_text(kSquare).scene;
  std::setlocale(LC_NUMERIC, c_before.c_str());
  std::locale::global(before);
  expect_same(german, plain);
}

TEST(ObjText, NumbersHaveManyForms) {
  const Scene scene = load_text("v .5 -.5 +.5\nv 5. 1e2 -1E-2\nv 0.1 1e-400 00012\nv 1e29 0 0\nf 1 2 3\n").scene;
  EXPECT_EQ(scene.positions[0], vec3(0.5f, -0.5f, 0.5f));
  EXPECT_EQ(scene.positions[1], vec3(5, 100, -0.01f));
  EXPECT_EQ(scene.positions[2], vec3(0.1f, 0, 12));
}

TEST(ObjText, FarFromTheOriginKeepsItsPrecision) {
  // A millimetre grid ten thousand kilometres away.
  const Scene scene = load_text(
                          "v 10000000.001 -10000000.002 5\nv 10000001.001 -10000000.002 5\n"
                          "v 10000000.001 -9999999.002 5.125\nf 1 2 3\n")
                          .scene;
  EXPECT_NE(scene.origin_world, dvec3(0));
  const vec3 edge = scene.positions[1] - scene.positions[0];
  EXPECT_NEAR(edge.x, 1, 1e-6);
  EXPECT_NEAR((dvec3(scene.positions[0]) + scene.origin_world).x, 10000000.001, 1e-6);
  EXPECT_NEAR((dvec3(scene.positions[2]) + scene.origin_world).y, -9999999.002, 1e-6);
  EXPECT_EQ(load_text(kSquare).scene.origin_world, dvec3(0));
}

TEST(ObjText, ALongFaceLinePasses) {
  constexpr int corners = 100'000;
  string text = fmt::format("v {} -1000 0\nv 0 -1000 0\n", corners);
  for (int i = 2; i < corners; ++i) text += fmt::format("v {} {} 0\n", i, i % 2);  // a comb
  text += "f";
  for (int i = 1; i <= corners; ++i) text += fmt::format(" {}", i == 1 ? 1 : corners + 2 - i);  // counter-clockwise
  const Loaded loaded = load_text(text);
  EXPECT_EQ(loaded.scene.triangle_count(), corners - 2u);
  EXPECT_TRUE(loaded.warnings.empty());
}

TEST(ObjText, AFaceOfRepeatedCornersTakesNoTime) {
  string text = kTriangle + "f 1 2 3\nf";
  for (int i = 0; i < 2'000'000; ++i) text += " 1";
  EXPECT_EQ(load_text(text).scene.triangle_count(), 1u);
}

}  // namespace
}  // namespace hybridrt
