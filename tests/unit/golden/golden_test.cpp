#include "core/golden/golden.h"

#include <gtest/gtest.h>

#include "core/base/error.h"
#include "core/golden/golden_report.h"
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
  EXPECT_EQ(list.cases[0].limits[0].fail, 0.01);
  EXPECT_EQ(list.cases[0].limits[0].fail_percent, 2);
  EXPECT_EQ(list.cases[0].limits[0].hard_fail, 0.5);
  EXPECT_EQ(list.cases[0].scene, "scene:spheres");
  EXPECT_EQ(list.cases[1].scene, "/x/y.obj");
  EXPECT_EQ(list.cases[1].limits[0].fail, 0.004) << "compare's defaults";
  EXPECT_EQ(list.cases[1].limits[0].fail_percent, 0.1);
  EXPECT_EQ(list.cases[1].limits[0].hard_fail, 0.1);
  EXPECT_EQ(list.expected(golden_picture_name(list.cases[1], 1, false)), folder_.path / "b.png");
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
  expect_refused(R"({"cases":[{"name":"a","scene":"s","reason":"r","options":"--size"}]})", "texts");
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

TEST_F(GoldenLists, AllThatIsWrongIsToldWithItsLine) {
  try {
    read(
        "{\n \"cases\": [\n  {\"name\": \"a {[\", \"scene\": \"s\", \"fial\": 1},\n  7,\n"
        "  {\"name\": \"b\", \"options\": [\"]\"],\n   \"reason\": \"r\"}\n ]\n}");
    FAIL();
  } catch (const Error& refused) {
    const std::string message = refused.what(), list_name = list().string();
    for (const std::string part : {":3: case 'a {[': unknown key 'fial'", ":3: case 'a {[': 'reason' is missing",
                                   ":4: case 2: must be an object", ":5: case 'b': 'scene' is missing"})
      EXPECT_NE(message.find(list_name + part), std::string::npos) << message;
  }
}

TEST_F(GoldenLists, LimitsAreOfAClassOfRenderer) {
  const GoldenList list = read(R"({"cases":[{"name":"a","scene":"s","reason":"r","fail":0.01,"budget":3.5,)"
                               R"("on_hardware_gl":{"fail_percent":2,"hard_fail":0.5},"on_cpu":{"fail":0}}]})");
  const GoldenCase& golden = list.cases[0];
  EXPECT_EQ(golden.limits_for(RendererClass::cpu).fail, 0);
  EXPECT_EQ(golden.limits_for(RendererClass::software_gl).fail, 0.01);
  EXPECT_EQ(golden.limits_for(RendererClass::hardware_gl).fail, 0.01);
  EXPECT_EQ(golden.limits_for(RendererClass::hardware_gl).fail_percent, 2);
  EXPECT_EQ(golden.limits_for(RendererClass::hardware_gl).hard_fail, 0.5);
  EXPECT_EQ(golden.limits_for(RendererClass::software_gl).hard_fail, 0.1);
  EXPECT_EQ(golden.budget, 3.5);
  expect_refused(R"({"cases":[{"name":"a","scene":"s","reason":"r","on_cpu":{"fial":1}}]})",
                 "on_cpu: unknown key 'fial'");
  expect_refused(R"({"cases":[{"name":"a","scene":"s","reason":"r","on_cpu":1}]})", "on_cpu");
  expect_refused(R"({"cases":[{"name":"a","scene":"s","reason":"r","budget":-1}]})", "budget");
}

TEST_F(GoldenLists, ACaseIsAppended) {
  std::string text = with_golden_case("", list(), "a", "a.obj", {"--fov", "30"}, "why");
  text = with_golden_case(text, list(), "b", "scene:chess", {}, "why not");
  const GoldenList read_back = read(text);
  ASSERT_EQ(read_back.cases.size(), 2u);
  EXPECT_EQ(read_back.cases[0].options, (std::vector<std::string>{"--fov", "30"}));
  EXPECT_EQ(read_back.cases[1].scene, "scene:chess");
  EXPECT_THROW(with_golden_case(text, list(), "a", "x.obj", {}, "r"), Error);
  EXPECT_THROW(with_golden_case("[", list(), "c", "x.obj", {}, "r"), Error);
}

TEST(GoldenPictures, OfSeveralFramesHaveTheirNumbers) {
  GoldenCase golden;
  golden.name = "car";
  EXPECT_EQ(golden_picture_name(golden, 7, false), "car");
  EXPECT_EQ(golden_picture_name(golden, 7, true), "car.0007");
}

GoldenResult passed_one(const std::string& name) {
  GoldenResult result;
  result.name = name;
  result.compared.same = result.compared.measured = true;
  return result;
}

TEST(GoldenReports, FailuresComeFirstAndNameWhatMadeThem) {
  GoldenResult results[] = {passed_one("fine"), passed_one("wrong"), passed_one("slow")};
  results[1].compared.same = false;
  results[1].where = "llvmpipe (LLVM 15)";
  results[1].expected = "out/wrong.expected.png", results[1].actual = "out/wrong.png";
  results[2].time = {4, 8, 2};
  const std::string page = golden_html(results, "hybridrt 1.2 (abc)");
  EXPECT_LT(page.find(">wrong "), page.find(">fine "));
  for (const char* part :
       {"1 failed, 2 passed", "hybridrt 1.2 (abc)", "llvmpipe (LLVM 15)", "src=\"./wrong.expected.png\"",
        "type=\"range\"", "width=device-width", "8.0 times the calibration, its budget is 2"})
    EXPECT_NE(page.find(part), std::string::npos) << part;
  EXPECT_EQ(page.find("http"), std::string::npos) << "nothing from elsewhere";
  results[2].enforce_time = true;
  EXPECT_FALSE(results[2].passed());
}

TEST(GoldenReports, BrokenCasesAreErrors) {
  GoldenResult results[] = {passed_one("fine"), passed_one("gone")};
  results[1].failure = "gone.obj cannot be opened", results[1].is_broken = true;
  const std::string xml = golden_junit(results);
  EXPECT_NE(xml.find("tests=\"2\" failures=\"0\" errors=\"1\""), std::string::npos) << xml;
  EXPECT_NE(xml.find("<error message=\"gone.obj cannot be opened\"/>"), std::string::npos) << xml;
}

TEST(GoldenReports, EscapeWhatTheyQuote) {
  GoldenResult result;
  result.name = "a<b>&\"c\"";
  result.reason = "because 1 < 2 & \"3\"";
  result.failure = "bad <thing> & \"other\"";
  for (const std::string& report : {golden_html({&result, 1}, "hybridrt"), golden_junit({&result, 1})}) {
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
