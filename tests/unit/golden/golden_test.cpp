#include "core/golden/golden.h"

#include <gtest/gtest.h>

#include "core/base/error.h"
#include "tests/support/temporary_folder.h"

namespace hybridrt {
namespace {

class GoldenLists : public testing::Test {
 protected:
  GoldenList read(const std::string& text) {
    std::ofstream(list()) << text;
    return read_golden_list(list());
  }
  std::filesystem::path list() const { return folder_.path / "list.json"; }

  void expect_refused(const std::string& text, const std::string& named) {
    try {
      read(text);
      ADD_FAILURE() << "accepted: " << text;
    } catch (const Error& refused) {
      const std::string message = refused.what();
      EXPECT_EQ(refused.kind(), ErrorKind::input) << message;
      EXPECT_NE(message.find("list.json"), std::string::npos) << message;
      EXPECT_NE(message.find(named), std::string::npos) << message << "\nshould name " << named;
      EXPECT_EQ(message.find('\n'), std::string::npos) << message;
    }
  }
  TemporaryFolder folder_;
};

TEST_F(GoldenLists, AWholeOne) {
  const GoldenList list =
      read(R"({"cases":[{"name":"a","scene":"scene:spheres","options":["--frames","5-5"],"fail":0.01,"fail_percent":2,)"
           R"("hard_fail":0.5,"reason":"why"},{"name":"b","scene":"/x/y.obj","reason":"r"}]})");
  ASSERT_EQ(list.cases.size(), 2u);
  EXPECT_EQ(list.cases[0].options, (std::vector<std::string>{"--frames", "5-5"}));
  EXPECT_EQ(list.cases[0].limits.fail, 0.01);
  EXPECT_EQ(list.cases[0].limits.fail_percent, 2);
  EXPECT_EQ(list.cases[0].limits.hard_fail, 0.5);
  EXPECT_EQ(list.cases[0].scene, "scene:spheres");
  EXPECT_EQ(list.cases[1].scene, "/x/y.obj");
  EXPECT_EQ(list.cases[1].limits.fail, 0.004) << "compare's defaults";
  EXPECT_EQ(list.cases[1].limits.fail_percent, 0.1);
  EXPECT_EQ(list.cases[1].limits.hard_fail, 0.1);
  EXPECT_EQ(list.expected(list.cases[1]), folder_.path / "b.png");
}

TEST_F(GoldenLists, ScenesAreLookedForBesideTheListThenAbove) {
  std::filesystem::create_directories(folder_.path / "golden");
  std::ofstream(folder_.path / "above.obj") << "x";
  std::ofstream(folder_.path / "golden" / "beside.obj") << "x";
  const std::filesystem::path list = folder_.path / "golden" / "list.json";
  std::ofstream(list) << R"({"cases":[{"name":"a","scene":"beside.obj","reason":"r"},)"
                      << R"({"name":"b","scene":"above.obj","reason":"r"}]})";
  const GoldenList read = read_golden_list(list);
  EXPECT_TRUE(std::filesystem::equivalent(read.cases[0].scene, folder_.path / "golden" / "beside.obj"));
  EXPECT_TRUE(std::filesystem::equivalent(read.cases[1].scene, folder_.path / "above.obj"));
}

TEST_F(GoldenLists, WhatIsWrongIsNamed) {
  expect_refused("", "not a golden list");
  expect_refused("{", "line 1");
  expect_refused("[]", "cases");
  expect_refused("{}", "cases");
  expect_refused(R"({"cases":[]})", "no cases");
  expect_refused(R"({"cases":7})", "cases");
  expect_refused(R"({"cases":[7]})", "list.json");
  expect_refused(R"({"cases":[{"scene":"s","reason":"r"}]})", "name");
  expect_refused(R"({"cases":[{"name":"a","reason":"r"}]})", "scene");
  expect_refused(R"({"cases":[{"name":"a","scene":"s"}]})", "reason");
  expect_refused(R"({"cases":[{"name":"ab","scene":"s","reason":"r","fial":1}]})", "fial");
  expect_refused(R"({"cases":[{"name":"ab","scene":"s","reason":"r","fial":1}]})", "'ab'");
  expect_refused(R"({"cases":[{"name":7,"scene":"s","reason":"r"}]})", "case 1");
  expect_refused(R"({"cases":[{"name":"a","scene":"s","reason":"r","fail":"x"}]})", "number");
  expect_refused(R"({"cases":[{"name":"a","scene":"s","reason":"r","options":"--size"}]})", "array");
  expect_refused(R"({"cases":[{"name":"a","scene":"s","reason":"r"},{"name":"a","scene":"t","reason":"r"}]})", "'a'");
  expect_refused(R"({"cases":[{"name":"../a","scene":"s","reason":"r"}]})", "../a");
  expect_refused(R"({"cases":[{"name":"","scene":"s","reason":"r"}]})", "name");
}

TEST_F(GoldenLists, UnknownKeysOfTheListAreNamed) {
  expect_refused(R"({"cases":[{"name":"a","scene":"s","reason":"r"}],"casez":[]})", "casez");
}

// A limit that nothing can exceed would let every picture pass.
TEST_F(GoldenLists, LimitsOutOfRangeAreRefused) {
  for (const char* limit : {R"("fail":-1)", R"("fail":2)", R"("fail_percent":101)", R"("hard_fail":-0.1)"})
    expect_refused(R"({"cases":[{"name":"a","scene":"s","reason":"r",)" + std::string(limit) + "}]}", "fail");
}

TEST_F(GoldenLists, MissingFileIsNamed) {
  EXPECT_THROW(read_golden_list(folder_.path / "gone.json"), Error);
  EXPECT_THROW(read_golden_list(folder_.path), Error) << "a folder";
}

TEST_F(GoldenLists, NamesPickCasesInTheListsOrder) {
  const auto fresh = [&] {
    return read(R"({"cases":[{"name":"a","scene":"s","reason":"r"},{"name":"b","scene":"s","reason":"r"},)"
                R"({"name":"c","scene":"s","reason":"r"}]})");
  };
  GoldenList list = fresh();
  keep_cases(list, std::vector<std::string>{"c", "a"});
  ASSERT_EQ(list.cases.size(), 2u);
  EXPECT_EQ(list.cases[0].name, "a");
  list = fresh();
  keep_cases(list, {});
  EXPECT_EQ(list.cases.size(), 3u);
  try {
    keep_cases(list, std::vector<std::string>{"b", "zebra"});
    FAIL();
  } catch (const Error& refused) {
    EXPECT_EQ(refused.kind(), ErrorKind::usage);
    EXPECT_NE(std::string(refused.what()).find("zebra"), std::string::npos);
  }
}

TEST(GoldenReports, EscapeWhatTheyQuote) {
  GoldenResult result;
  result.golden.name = "a<b>&\"c\"";
  result.golden.reason = "because 1 < 2 & \"3\"";
  result.failure = "bad <thing> & \"other\"";
  for (const std::string& report : {golden_html({&result, 1}, "/tmp"), golden_junit({&result, 1})}) {
    EXPECT_EQ(report.find("<thing>"), std::string::npos) << report;
    EXPECT_EQ(report.find("a<b>"), std::string::npos) << report;
    EXPECT_NE(report.find("&lt;thing&gt;"), std::string::npos) << report;
    EXPECT_EQ(report.find("& "), std::string::npos) << report;
  }
  EXPECT_FALSE(result.passed());
  EXPECT_NE(golden_junit({&result, 1}).find("<failure"), std::string::npos);
}

}  // namespace
}  // namespace hybridrt
