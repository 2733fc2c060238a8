// OFF as data sets and other programs write it: all of these are one square.

#include "core/load/mesh_io.h"
#include "tests/support/mesh_test.h"

namespace hybridrt {
namespace {

using std::string;

const string kFour = "0 0 0\n2 0 0\n2 1 0\n0 1 0\n", kFace = "4 0 1 2 3\n";

void expect_square(const Loaded& loaded, const string& what, size_t warnings = 0) {
  EXPECT_EQ(loaded.warnings.size(), warnings) << what;
  ASSERT_EQ(loaded.scene.positions.size(), 4u) << what;
  EXPECT_EQ(loaded.scene.triangle_count(), 2u) << what;
  EXPECT_EQ(loaded.scene.positions[2], vec3(2, 1, 0)) << what;
}

/// The square with `more` after each position.
string with(const string& keyword, const string& more) {
  string text = keyword + "\n4 1 0\n";
  for (const char* corner : {"0 0 0", "2 0 0", "2 1 0", "0 1 0"}) text += string(corner) + " " + more + "\n";
  return text + kFace;
}

vec3 first_color(const Loaded& loaded) { return loaded.scene.colors[loaded.scene.triangle_colors[0].x]; }
vec3 first_normal(const Loaded& loaded) { return loaded.scene.normals[loaded.scene.triangle_normals[0].x]; }

TEST(OffForms, KeywordAndCounts) {
  for (const string head : {"OFF\n4 1 4\n",
                            "OFF4 1 4\n",
                            "OFF 4 1 4\n",
                            "off\n4 1 4\n",
                            "Off4 1 4\n",
                            "4 1 4\n",
                            "4 1\n",
                            "OFF 4 1\n",
                            "OFF\n4\n1\n4\n",
                            "OFF 4\n1 4\n",
                            "OFF\n4 1\n4\n",
                            "4\n1\n4\n",
                            "\xEF\xBB\xBFOFF4 1 4\n",
                            "# by hand\n\nOFF # here\n"
                            "# and here\n 4 # corners\n1 #face\n 4\n",
                            "nOFF\n3\n4 1 4\n",
                            "nOFF 3\n4 1 4\n",
                            "nOFF 3 4 1 4\n",
                            "nOFF\n4 1 4\n",
                            "nOFF\n3\n4\n1\n4\n",
                            "OFF 4 1 4 0\n"})
    expect_square(load("a.off", head + kFour + kFace), head);
}

TEST(OffForms, AllOnOneLineOrWrapped) {
  string text = "OFF 4 1 4 " + kFour + kFace;
  std::replace(text.begin(), text.end(), '\n', ' ');
  expect_square(load("a.off", text), "one line");
  expect_square(load("a.off", "OFF 4 1 4 0 0 0 2 # so far\n0 0 2 1\n0 0 1 0 4\n0 1 2\n3"), "wrapped");
  EXPECT_TRUE(contains(failure("a.off", text.substr(0, text.size() - 4)), "cut short"));
}

TEST(OffForms, HomogeneousCoordinatesAreDividedOut) {
  for (const char* head : {"4OFF\n4 1 0\n", "4nOFF\n3\n4 1 0\n"})
    expect_square(load("a.off", string(head) + "0 0 0 1\n4 0 0 2\n1 .5 0 .5\n0 1 0 1\n" + kFace), head);
  EXPECT_TRUE(
      contains(failure("a.off", "4OFF\n3 1 0\n0 0 0 1\n1 0 0 0\n0 1 0 1\n3 0 1 2\n"), "coordinate is infinite"));
}

TEST(OffForms, NormalsOfEveryKeyword) {
  for (const string keyword : {"NOFF", "noff", "nOFF", "STNOFF", "stnoff", "NSTOFF"}) {
    const string texture = keyword.size() > 4 ? " 0.5 0.5" : "";
    const Loaded loaded = load("a.off", with(keyword, "0 0 -1" + texture));
    expect_square(loaded, keyword, texture.empty() ? 0 : 1);
    EXPECT_EQ(first_normal(loaded), vec3(0, 0, -1)) << keyword;
  }
  const Loaded textured = load("a.off", with("STOFF", "0.5 0.5"));
  expect_square(textured, "texture coordinates alone", 1);
  EXPECT_TRUE(warned(textured.warnings, "texture coordinates were left out: OFF names no texture"));
  EXPECT_TRUE(contains(failure("a.off", with("NOFF", "0 0")), "a.off:3: a number is missing"));
}

TEST(OffForms, ColoursBeforeNormalsAsMeshLabWritesThemOrAfter) {
  const string n = "0 0 -1";
  for (const string keyword : {"NCOFF", "CNOFF", "cnoff", "STCNOFF"})
    for (const string color : {"255 0 0 255", "1 0 0 1", "0.5 0.25 0.5 1", "12 34 56", "0 0 1"})
      for (const string& order : {color + " " + n, n + " " + color}) {
        const Loaded loaded = load("a.off", with(keyword, order + (keyword[0] == 'S' ? " 0 1" : "")));
        EXPECT_EQ(first_normal(loaded), vec3(0, 0, -1)) << keyword << " " << order;
        EXPECT_TRUE(loaded.scene.has_colors()) << keyword << " " << order;
        if (color != "255 0 0 255") continue;
        EXPECT_EQ(first_color(loaded), vec3(1, 0, 0)) << keyword << " " << order;
      }
  // Nothing is impossible here, but one order makes unit normals.
  EXPECT_EQ(first_normal(load("a.off", with("NCOFF", "0 1 0 1 1 1 0"))), vec3(0, 1, 0));
  EXPECT_EQ(first_normal(load("a.off", with("NCOFF", "1 1 0 1 0 1 0"))), vec3(0, 1, 0));
  EXPECT_EQ(first_normal(load("a.off", with("CNOFF", "1 0 0 1 0 1 0"))), vec3(0, 1, 0)) << "if all fits, MeshLab's";
}

TEST(OffForms, ColoursOfFacesAndOfSomeVertices) {
  EXPECT_EQ(first_color(load("a.off", "COFF\n4 1 0\n" + kFour + "4 0 1 2 3 1 0 1\n")), vec3(1, 0, 1));
  const Loaded some = load("a.off", "OFF\n4 1 0\n0 0 0\n2 0 0 255 0 0\n2 1 0 0 255 0 255\n0 1 0\n3 0 1 2\n");
  EXPECT_EQ(some.scene.colors[some.scene.triangle_colors[0].x], vec3(1));
  EXPECT_EQ(some.scene.colors[some.scene.triangle_colors[0].y], vec3(1, 0, 0));
  EXPECT_EQ(some.scene.colors[some.scene.triangle_colors[0].z], vec3(0, 1, 0));
  EXPECT_TRUE(warned(load("a.off", "OFF\n4 1 0\n0 0 0 7\n2 0 0 7\n2 1 0 7\n0 1 0 7\n" + kFace).warnings,
                     "its vertices have colours of 1 numbers, not three or four"));
  EXPECT_TRUE(warned(load("a.off", "COFF\n4 1 0\n0 0 0 1 0 0 .5\n2 0 0 1 0 0 1\n2 1 0\n0 1 0\n" + kFace).warnings,
                     "1 vertices have a colour with an alpha below 1, which is not read"));
}

TEST(OffForms, WhatIsNotOff) {
  for (const char* word : {"solid", "v", "offset", "XOFF", "OFFx", "coffee", "ply"})
    EXPECT_TRUE(contains(failure("a.off", string(word) + "\n4 1 0\n" + kFour + kFace), "it is not an OFF file"))
        << word;
  EXPECT_TRUE(contains(failure("a.off", "off binary\n"), "binary OFF is not read"));
  EXPECT_TRUE(contains(failure("a.off", "0.5 1 2\n"), "0.5 is not a count"));
  EXPECT_TRUE(contains(failure("a.off", "OFF4"), "cut short"));
  EXPECT_TRUE(contains(failure("a.off", "OFF\nnan 1 0\n"), "NaN or infinity where a count"));
}

}  // namespace
}  // namespace hybridrt
