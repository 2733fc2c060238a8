#include "core/base/warnings.h"

#include <algorithm>
#include <gtest/gtest.h>
#include <set>
#include <type_traits>

namespace hybridrt {
namespace {

// No warning leaves without a code.
static_assert(!std::is_default_constructible_v<Warning>);
static_assert(!std::is_constructible_v<Warning, std::string>);
static_assert(!std::is_constructible_v<Warning, std::string, std::string>);
static_assert(!std::is_convertible_v<std::string, Warning>);
static_assert(std::is_constructible_v<Warning, WarningCode, std::string>);

TEST(WarningCodes, AreInTheOrderOfTheirValues) {
  for (size_t i = 0; i < std::size(kWarningCodes); ++i) EXPECT_EQ(static_cast<size_t>(kWarningCodes[i].value), i);
}

TEST(WarningCodes, AreWordsWithDashesBetweenThem) {
  std::set<std::string_view> names;
  for (const auto& [name, code] : kWarningCodes) {
    EXPECT_TRUE(names.insert(name).second) << name;
    EXPECT_TRUE(std::all_of(name.begin(), name.end(), [](char c) { return c == '-' || (c >= 'a' && c <= 'z'); }));
    EXPECT_TRUE(name.size() > 2 && name.front() != '-' && name.back() != '-') << name;
  }
}

TEST(Report, CountsCasesOfOneKind) {
  Warnings warnings;
  report(WarningCode::line_unknown, Tally{}, "lines", "a/b.obj", warnings);
  EXPECT_TRUE(warnings.empty()) << "there were none";
  report(WarningCode::line_unknown, Tally{3, 7}, "lines were left out", "a/b.obj", warnings);
  EXPECT_TRUE(warnings == (Warnings{{WarningCode::line_unknown, "b.obj: 3 lines were left out (first at line 7)"}}));
}

}  // namespace
}  // namespace hybridrt
