// STL as scripts and streaming writers leave it.

#include "core/load/mesh_io.h"
#include "core/load/stl_io.h"
#include "tests/support/mesh_test.h"

namespace hybridrt {
namespace {

using std::string;

const string kFacet =
    "facet normal 0 0 1\n outer loop\n  vertex 0 0 0\n  vertex 1 0 0\n  vertex 0 1 0\n endloop\nendfacet\n";

string binary_stl(const string& header, uint32_t promised, int facets) {
  string text = header + string(80 - header.size(), ' ') + bytes(promised);
  for (int i = 0; i < facets; ++i) {
    for (float value : {0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0}) text += bytes(value);
    text += string(2, '\0');
  }
  return text;
}

TEST(StlForms, TheSizeSpeaksForACountThatWasNotFilledIn) {
  for (const uint32_t promised : {0u, 0xFFFFFFFFu})
    for (const string header : {"solid by a streaming writer", "binary"}) {
      const Loaded loaded = load("a.stl", binary_stl(header, promised, 3));
      EXPECT_EQ(loaded.scene.triangle_count(), 3u);
      EXPECT_TRUE(warned(loaded.warnings, "its header promises " + std::to_string(promised) +
                                              " facets, but its size is that of 3, which were read"));
      EXPECT_EQ(loaded.warnings.size(), 1u);
      EXPECT_TRUE(
          contains(failure("a.stl", binary_stl(header, promised, 3) + "x"), std::to_string(promised) + " facets"));
      EXPECT_NE(failure("a.stl", binary_stl(header, promised, 0)), "");
    }
}

TEST(StlForms, TextMayBeginWithWhatItLikes) {
  const string solid = "solid a\n" + kFacet + "endsolid a\n";
  for (const string start : {"# made by a script\n", "\n\n  \n", "\xEF\xBB\xBF", "\xEF\xBB\xBF# \xC3\xA9\n\r\n", "\t",
                             "# facets: 1\r\n#\r\n"}) {
    const Loaded loaded = load("a.stl", start + solid);
    EXPECT_TRUE(loaded.warnings.empty()) << start;
    EXPECT_EQ(loaded.scene.triangle_count(), 1u) << start;
  }
  EXPECT_EQ(load("a.stl", "solid a\n# between\n" + kFacet + "  # and behind\nendsolid\n").scene.triangle_count(), 1u);
  EXPECT_EQ(load("a.stl", kFacet + "endsolid\n").scene.triangle_count(), 1u);
  // A long name, so that the count of a binary file would lie in it.
  EXPECT_EQ(load("a.stl", "solid " + string(300, 'x') + "\n" + kFacet + "endsolid\n").scene.triangle_count(), 1u);
}

TEST(StlForms, TextIsNeverCalledBinary) {
  string wide, plain = "solid a\n" + kFacet;
  for (const char c : plain) wide += string(1, c) + '\0';
  string damaged = plain + "endsolid\n";
  damaged[60] = '\0';
  for (const string& text :
       {string("hello world, this is a text file that is no STL file but long enough to be one\n\n"),
        string("# only a comment\n"), wide, "\xFF\xFE" + wide, damaged, plain + "\x1A"}) {
    const string message = failure("a.stl", text);
    EXPECT_FALSE(contains(message, "binary STL")) << message;
    EXPECT_FALSE(contains(message, "neither")) << message;
  }
}

TEST(StlForms, AMissingEndsolidIsTold) {
  EXPECT_TRUE(warned(load("a.stl", "\nsolid a\n" + kFacet).warnings,
                     "1 solids have no 'endsolid'; is the file cut short? (first at line 2)"));
  EXPECT_TRUE(warned(load("a.stl", kFacet + kFacet).warnings, "1 solids have no 'endsolid'"));
  EXPECT_TRUE(warned(load("a.stl", "solid\n" + kFacet + "solid b\n" + kFacet + "endsolid\nsolid\n").warnings,
                     "2 solids have no 'endsolid'; is the file cut short? (first at line 1)"));
  EXPECT_TRUE(load("a.stl", "SOLID a\n" + kFacet + "EndSolid a\nsolid b\n" + kFacet + "endsolid\n").warnings.empty());
}

}  // namespace
}  // namespace hybridrt
