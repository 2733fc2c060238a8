#include "core/render/output_pattern.h"

#include <gtest/gtest.h>

#include "core/base/error.h"

namespace hybridrt {
namespace {

struct PatternCase {
  const char* pattern;
  bool several_frames;
  int64_t frame;
  const char* aov;
  const char* expected;
};

class OutputPatternCases : public testing::TestWithParam<PatternCase> {};

TEST_P(OutputPatternCases, Expand) {
  const PatternCase& c = GetParam();
  EXPECT_EQ(output_path(parse_output_pattern(c.pattern, c.several_frames), c.frame, c.aov).string(), c.expected)
      << c.pattern;
}

INSTANTIATE_TEST_SUITE_P(, OutputPatternCases,
                         testing::Values(PatternCase{"out/name.####.png", true, 7, "", "out/name.0007.png"},
                                         PatternCase{"out/name.####.png", false, 7, "", "out/name.0007.png"},
                                         PatternCase{"name.##.png", true, 12345, "", "name.12345.png"},
                                         PatternCase{"name.####.png", true, 1000000000000, "",
                                                     "name.1000000000000.png"},
                                         PatternCase{"out/{frame:04}.png", true, 42, "", "out/0042.png"},
                                         PatternCase{"out/{frame:04}.png", true, 42424, "", "out/42424.png"},
                                         PatternCase{"out/a{frame}b.png", true, 42, "", "out/a42b.png"},
                                         PatternCase{"f{frame:03}/a.png", true, 4, "", "f004/a.png"},
                                         PatternCase{"c#/a.png", true, 4, "", "c#/a.0004.png"},
                                         PatternCase{"c#/a.png", false, 4, "", "c#/a.png"},
                                         PatternCase{"out/name.png", true, 7, "", "out/name.0007.png"},
                                         PatternCase{"out/name.png", false, 7, "", "out/name.png"},
                                         PatternCase{"/tmp/v1.2/name", true, 7, "", "/tmp/v1.2/name.0007"},
                                         PatternCase{"a{b}.png", true, 7, "", "a{b}.0007.png"},
                                         PatternCase{"name.####.png", true, 7, "depth", "name.depth.0007.png"},
                                         PatternCase{"name_####.png", true, 7, "depth", "name_depth_0007.png"},
                                         PatternCase{"name####.png", true, 7, "id", "name.id.0007.png"},
                                         PatternCase{"####.png", true, 7, "id", "id.0007.png"},
                                         PatternCase{"out/name.png", true, 7, "id", "out/name.id.0007.png"},
                                         PatternCase{"out/name.png", false, 7, "id", "out/name.id.png"},
                                         PatternCase{"f{frame:03}/a.png", true, 4, "id", "f004/a.id.png"},
                                         PatternCase{"a.{frame:04}.png", true, 4, "id", "a.id.0004.png"}));

TEST(OutputPattern, CommonFolderIsTheDeepestThatDoesNotVary) {
  struct Case {
    const char *pattern, *folder, *below;
  };
  for (const Case& c :
       {Case{"a.png", ".", "a.#.png"}, Case{"out/a.##.png", "out", "a.#.png"}, Case{"q/{frame}/a.png", "q", "#/a.png"},
        Case{"q/r/x{frame:3}/s/a.####.png", "q/r", "x#/s/a.#.png"}, Case{"{frame}/a.png", ".", "#/a.png"},
        Case{"/{frame}/a.png", "/", "#/a.png"}, Case{"/a.{frame}.png", "/", "a.#.png"},
        Case{"c#/a.png", "c#", "a.#.png"}}) {
    const OutputPattern pattern = parse_output_pattern(c.pattern, true);
    EXPECT_EQ(common_folder(pattern).string(), c.folder) << c.pattern;
    EXPECT_EQ(name_below(pattern), c.below) << c.pattern;
  }
}

TEST(OutputPattern, RefusesWhatNamesNoFile) {
  for (const char* pattern :
       {"", "out/", "out/..", "{frame:x}.png", "{frame:04", "{frames}.png", "a{frame:}.png", "{frame:123}.png"}) {
    try {
      parse_output_pattern(pattern, true);
      ADD_FAILURE() << pattern << " was accepted";
    } catch (const Error& refusal) {
      EXPECT_EQ(refusal.kind(), ErrorKind::usage) << pattern;
    }
  }
}

}  // namespace
}  // namespace hybridrt
